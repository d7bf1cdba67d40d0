package io.furrow.control.audit;

import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.StringJoiner;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A command and its result: a record of {@code service.audit}.
 *
 * @param time when it was answered, epoch ms
 * @param user user who issued it; {@value #KAFKA} if a record on Kafka did not name one
 * @param target its recipient: the topic of a manager, or {@value #DEVICE}
 * @param command name of the command; null if unreadable
 * @param about members of the command that are strings, numbers or booleans, for instance mission and device, and the
 *     counts and names of the answer
 * @param result what the command did, {@code error} if it was rejected or failed; {@code dry-run} if nothing was changed
 * @param error code of the error; null if none
 * @param reason of the error, a sentence; null if none
 * @param requestId null if it has none
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
        String requestId)
        implements StateRecord {
    /** As target: a command to a device, through the context broker. */
    public static final String DEVICE = "device";
    /** As user: anybody with write access to the topics of the managers. */
    public static final String KAFKA = "kafka";
    /** Member of requests that names the requesting user; it does not affect the decision of a manager. */
    public static final String USER = "user";

    private static final int MAX_LENGTH = 200;
    private static final int MAX_MEMBERS = 20;

    /** Creates the entry of a request to a manager and its answer. The request may be anything, even invalid JSON. */
    public static AuditEntry of(String topic, byte[] request, CommandResult answer, long now) {
        JsonNode json = read(request);
        ObjectNode about = NgsiJson.object();
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (about.size() < MAX_MEMBERS && isPlain(member.getKey()) && isShort(member.getValue())) {
                about.set(member.getKey(), member.getValue());
            }
        }
        JsonNode user = about.remove(USER);
        JsonNode named = about.remove("command");
        String command = named == null ? null : named.asText();
        about.remove("requestId");
        about.remove("type");
        addEffects(about, answer.json());
        return new AuditEntry(
                now,
                user == null || user.asText().isBlank() ? KAFKA : user.asText(),
                topic,
                command,
                about,
                answer.after(command).outcome(),
                answer.error().orElse(null),
                answer.json().path("reason").textValue(),
                answer.requestId().orElse(null));
    }

    /**
     * Creates the entry of a command to a device.
     *
     * @param reason why it failed; null if the context broker accepted it
     */
    public static AuditEntry ofDevice(long now, String user, String command, ObjectNode about, String reason) {
        boolean failed = reason != null;
        return new AuditEntry(
                now,
                user,
                DEVICE,
                command,
                about,
                failed ? CommandResult.ERROR : "sent",
                failed ? "context-broker" : null,
                reason,
                null);
    }

    /** Adds the counts of the answer, and its lists of names as texts. */
    private static void addEffects(ObjectNode about, ObjectNode answer) {
        answer.properties().forEach(member -> {
            JsonNode value = member.getValue();
            if (value.isIntegralNumber() && value.canConvertToLong()) {
                about.set(member.getKey(), value);
            } else if (value.isArray() && !value.isEmpty()) {
                StringJoiner names = new StringJoiner(", ");
                value.forEach(name -> names.add(name.asText()));
                String all = names.toString();
                about.put(member.getKey(), all.length() <= MAX_LENGTH ? all : all.substring(0, MAX_LENGTH - 1) + "…");
            }
        });
    }

    private static JsonNode read(byte[] request) {
        try {
            return NgsiJson.read(request);
        } catch (UnreadableException e) { // the answer reports it
            return NgsiJson.object();
        }
    }

    private static boolean isShort(JsonNode value) {
        boolean number = value.isIntegralNumber() && value.canConvertToLong()
                || value.isNumber()
                        && Double.isFinite(value.doubleValue())
                        && value.asText().length() <= MAX_LENGTH;
        return value.isBoolean() || number || value.isTextual() && isPlain(value.textValue());
    }

    /** A lone surrogate cannot be encoded in UTF-8. */
    private static boolean isPlain(String text) {
        return text.length() <= MAX_LENGTH
                && StandardCharsets.UTF_8.newEncoder().canEncode(text);
    }
}
