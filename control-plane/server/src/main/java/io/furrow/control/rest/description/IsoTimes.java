package io.furrow.control.rest.description;

import java.time.Instant;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.node.TextNode;

/** Replaces times in ms since the epoch by ISO 8601, where the description has a time. */
final class IsoTimes {
    private IsoTimes() {}

    /** Changes a value. Members that the description does not have stay as they are. */
    static void write(JsonNode value, MemberNames known) {
        if (value.isArray()) {
            MemberNames element = known.ofElement();
            value.forEach(each -> write(each, element));
        } else if (value instanceof ObjectNode object) {
            for (Map.Entry<String, JsonNode> member : object.properties()) {
                MemberNames names = known.ofMember(member.getKey());
                if (names.isTime() && member.getValue().canConvertToLong()) {
                    member.setValue(TextNode.valueOf(
                            Instant.ofEpochMilli(member.getValue().longValue()).toString()));
                } else if (member.getValue().isContainerNode()
                        && !names.schemas().isEmpty()) {
                    write(member.getValue(), names);
                }
            }
        }
    }
}
