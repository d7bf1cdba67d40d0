package io.furrow.model.control;

import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ObjectNode;

/** The source of a mission's devices. */
public sealed interface MissionPlan {
    /** @param version 0 for the newest at the time of the request */
    record FromTemplate(String template, int version) implements MissionPlan {}

    record OfDevices(MissionDevices devices) implements MissionPlan {}

    /** Not specified: the mission keeps its devices, a new one has none. */
    record Unspecified() implements MissionPlan {}

    /** The member {@code template}: a name, or {@code <name>@<version>}. */
    Pattern TEMPLATE = Pattern.compile("([A-Za-z0-9_-]{1,64})(?:@([1-9][0-9]{0,8}))?");

    static MissionPlan read(JsonObjectReader members) throws RejectedException {
        JsonObjectReader.refuseIf(
                members.has("template") && members.has("devices"), "devices", "missing where there is a 'template'");
        if (members.has("template")) {
            Matcher template = TEMPLATE.matcher(members.text("template"));
            if (!template.matches()) {
                throw new RejectedException(
                        ErrorCode.ILLEGAL_NAME, "'template' must be the name of one, or <name>@<version>");
            }
            String version = template.group(2);
            return new FromTemplate(template.group(1), version == null ? 0 : Integer.parseInt(version));
        }
        return members.has("devices")
                ? new OfDevices(MissionDevices.read(members).withValidAreas())
                : new Unspecified();
    }

    /** Puts {@code template} or {@code devices}. */
    default void describe(ObjectNode json) {
        if (this instanceof FromTemplate from) {
            json.put("template", from.version() == 0 ? from.template() : from.template() + "@" + from.version());
        } else if (this instanceof OfDevices of) {
            json.set("devices", of.devices().toJson());
        }
    }
}
