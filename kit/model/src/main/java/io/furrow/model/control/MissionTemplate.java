package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A template of missions: {@code {"template": …, "version": …, "description": …, "devices": […]}}, a record of {@code
 * service.templates} with the key {@link #key()}, and the format of exported and imported templates.
 *
 * @param version from 1; a version never changes. 0 if it is not assigned yet
 * @param description null if there is none
 */
public record MissionTemplate(
        @JsonProperty("template") String name,
        @JsonInclude(JsonInclude.Include.NON_DEFAULT) int version,
        String description,
        MissionDevices devices)
        implements StateRecord {
    /** Returns {@code <name>@<version>}. */
    public String key() {
        return name + "@" + version;
    }

    /** Returns the template with another version. */
    public MissionTemplate as(int newVersion) {
        return new MissionTemplate(name, newVersion, description, devices);
    }

    /**
     * Reads an exported template, including the version if it has one.
     *
     * @throws RejectedException if it is invalid; the message names the member
     */
    public static MissionTemplate read(byte[] value) throws RejectedException {
        try {
            JsonNode json = NgsiJson.read(value);
            if (!(json instanceof ObjectNode object)) {
                throw new RejectedException(ErrorCode.NOT_JSON, "the template is not an object");
            }
            JsonObjectReader.checkReadable(json);
            return read(new JsonObjectReader(object));
        } catch (UnreadableException e) {
            throw new RejectedException(ErrorCode.NOT_JSON, JsonObjectReader.quotable(e.getMessage()));
        }
    }

    public static MissionTemplate read(JsonObjectReader members) throws RejectedException {
        return new MissionTemplate(
                members.name("template"),
                members.wholeNumber("version", 0, Integer.MAX_VALUE, 0),
                members.textOrNull("description"),
                MissionDevices.read(members));
    }
}
