package io.furrow.control.audit;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.Response;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A command that somebody gave: a record of {@code service.audit}.
 *
 * @param time when it was answered, epoch ms
 * @param user who gave it; {@value #KAFKA} where a record on Kafka did not say
 * @param target whom it was given to: the topic of a manager, or {@value #DEVICE}
 * @param command what to do; null where that could not be read
 * @param about members of the command that are texts, numbers and flags: which mission, which device
 * @param result {@code error} where it was refused or failed
 * @param error code of the error; null where there is none
 * @param reason of the error, a sentence; null where there is none
 * @param requestId null where it has none
 */
public record AuditEntry(
        long time,
        String user,
        String target,
        String command,
        ObjectNode about,
        String result,
        String error,
        String reason,
        String requestId) {
    /** As target: a command to a device, through the context broker. */
    public static final String DEVICE = "device";
    /** As user: whoever may write to the topics of the managers. */
    public static final String KAFKA = "kafka";
    /** Who asks: a member of requests that no manager acts on. */
    public static final String USER = "user";

    private static final int LONGEST = 200;
    private static final int MOST_MEMBERS = 20;

    /** What a manager was asked and answered. The request may be anything, also no JSON. */
    public static AuditEntry of(String topic, byte[] request, Response answer, long now) {
        JsonNode json = read(request);
        ObjectNode about = JsonNodeFactory.instance.objectNode();
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (about.size() < MOST_MEMBERS && isPlain(member.getKey()) && isShort(member.getValue())) {
                about.set(member.getKey(), member.getValue());
            }
        }
        JsonNode user = about.remove(USER);
        JsonNode command = about.remove("command");
        about.remove("requestId");
        about.remove("type");
        return new AuditEntry(
                now,
                user == null || user.asText().isBlank() ? KAFKA : user.asText(),
                topic,
                command == null ? null : command.asText(),
                about,
                answer.status(),
                answer.error().orElse(null),
                answer.json().path("reason").textValue(),
                answer.requestId().orElse(null));
    }

    /** A command to a device that the context broker took, or that failed for a reason. @param reason null where it did not fail */
    public static AuditEntry ofDevice(long now, String user, String command, ObjectNode about, String reason) {
        boolean failed = reason != null;
        return new AuditEntry(
                now,
                user,
                DEVICE,
                command,
                about,
                failed ? Response.ERROR : "sent",
                failed ? "context-broker" : null,
                reason,
                null);
    }

    private static JsonNode read(byte[] request) {
        try {
            return NgsiJson.read(request);
        } catch (UnreadableException e) { // as the answer says already
            return JsonNodeFactory.instance.objectNode();
        }
    }

    private static boolean isShort(JsonNode value) {
        boolean number = value.isIntegralNumber() && value.canConvertToLong()
                || value.isNumber()
                        && Double.isFinite(value.doubleValue())
                        && value.asText().length() <= LONGEST;
        return value.isBoolean() || number || value.isTextual() && isPlain(value.textValue());
    }

    /** Half of a surrogate pair has no form in UTF-8. */
    private static boolean isPlain(String text) {
        return text.length() <= LONGEST && StandardCharsets.UTF_8.newEncoder().canEncode(text);
    }

    /** UTF-8 JSON; members without a value are left out. */
    public byte[] toBytes() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("time", time).put("user", user).put("target", target);
        put(json, "command", command);
        json.set("about", about);
        json.put("result", result);
        put(json, "error", error);
        put(json, "reason", reason);
        put(json, "requestId", requestId);
        return NgsiJson.write(json);
    }

    private static void put(ObjectNode json, String member, String value) {
        if (value != null) {
            json.put(member, value);
        }
    }
}
