package io.furrow.control.rest.view;

import com.fasterxml.jackson.databind.node.ObjectNode;

/** An entry of the audit topic. @param position its offset */
public record AuditedEntry(long position, ObjectNode value) {
    /** Returns the entry with its position, which pages refer to. */
    public ObjectNode json() {
        return value.put("position", position);
    }

    /** @param desired null for any */
    public boolean isAbout(String member, String desired) {
        return desired == null
                || desired.equals(value.path("about").path(member).textValue());
    }
}
