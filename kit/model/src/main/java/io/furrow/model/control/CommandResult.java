package io.furrow.model.control;

import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The answer of a manager: {@code type=response}, {@code status}, and the members of the command.
 *
 * @param json the whole message; owned by the response, not to be changed by readers
 */
public record CommandResult(ObjectNode json) {
    /** The status of all rejections. */
    public static final String ERROR = "error";

    /** Member of requests that are only answered, and of their answers. */
    public static final String DRY_RUN = "dryRun";

    private static final String REQUEST_ID = "requestId";

    /** Returns an answer with a status, for instance {@code created}. */
    public static CommandResult of(String status) {
        ObjectNode json = NgsiJson.object();
        return new CommandResult(json.put("type", "response").put("status", status));
    }

    static CommandResult rejected(RejectedException rejection) {
        return ofError(rejection.code().code(), rejection.getMessage());
    }

    /** @param error a code */
    public static CommandResult ofError(String error, String reason) {
        return of(ERROR).with("error", error).with("reason", reason);
    }

    /**
     * Returns a copy whose status is what the command did: on their topics the managers answer a start with
     * {@code created} and a stop with {@code deleted}.
     */
    public CommandResult after(String command) {
        return switch (command + " " + status()) {
            case "start created" -> with("status", json.has("start") ? "scheduled" : "started");
            case "stop deleted" -> with("status", "stopped");
            default -> this;
        };
    }

    /** Returns a copy with one more member; unchanged for null. */
    public CommandResult with(String member, String value) {
        return value == null ? this : new CommandResult(json.deepCopy().put(member, value));
    }

    public CommandResult with(String member, long value) {
        return new CommandResult(json.deepCopy().put(member, value));
    }

    public CommandResult with(String member, List<String> values) {
        ObjectNode members = json.deepCopy();
        values.forEach(members.putArray(member)::add);
        return new CommandResult(members);
    }

    /** Returns a copy that says that nothing was changed. */
    public CommandResult ofDryRun() {
        return new CommandResult(json.deepCopy().put(DRY_RUN, true));
    }

    public boolean isDryRun() {
        return json.path(DRY_RUN).asBoolean();
    }

    /** Returns the answer to a request; the id may be null. */
    public CommandResult to(String requestId) {
        return with(REQUEST_ID, requestId);
    }

    /** Returns the status, or {@code dry-run} of what was accepted and changed nothing. */
    public String outcome() {
        return isDryRun() && error().isEmpty() ? "dry-run" : status();
    }

    public String status() {
        return json.path("status").asText();
    }

    /** Returns the code of an error; otherwise empty. */
    public Optional<String> error() {
        return Optional.ofNullable(json.path("error").textValue());
    }

    public Optional<String> requestId() {
        return Optional.ofNullable(json.path(REQUEST_ID).textValue());
    }

    /**
     * Reads a message; unknown members are kept.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not a response
     */
    public static CommandResult read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        if (!(json instanceof ObjectNode object)
                || !"response".equals(json.path("type").textValue())
                || !json.path("status").isTextual()) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "it is not an object with type=response and a status");
        }
        return new CommandResult(object);
    }

    public byte[] toBytes() {
        return NgsiJson.write(json);
    }
}
