package io.furrow.control.rest.view;

import com.fasterxml.jackson.databind.node.ObjectNode;

/** An entry of the audit topic. @param position its offset there: older ones have lower ones */
public record AuditedEntry(long position, ObjectNode value) {
    /** With its position, by which older ones are asked for. */
    public ObjectNode json() {
        return value.put("position", position);
    }

    /** @param desired null for any */
    public boolean isAbout(String member, String desired) {
        return desired == null
                || desired.equals(value.path("about").path(member).textValue());
    }
}
