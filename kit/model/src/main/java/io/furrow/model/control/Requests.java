package io.furrow.model.control;

import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.TopicName;

/**
 * Converts requests to and from JSON. Reading never throws: an invalid request is {@link ParsedRequest.Refused} with a
 * code and a sentence. Unknown members are ignored, because older clients send some.
 */
public final class Requests {
    /** Member of requests that are refused if what they change has another sequence. */
    public static final String IF_SEQUENCE = "ifSequence";

    private static final Pattern REQUEST_ID = Pattern.compile("[!-~]{1,200}");
    /** Members that are repeated in errors for clients without request ids. */
    private static final List<String> SUBJECTS = List.of("domain", "mission", "replay", "group", "alarm");

    private Requests() {}

    /** Reads a command from a request's members. */
    private interface Reader<C> {
        C read(String verb, JsonObjectReader members) throws RejectedException;
    }

    /** Reads a record of {@code service.domainmanager}; the value may be null. */
    public static ParsedRequest<DomainCommand> domain(byte[] value) {
        return read(value, DomainCommand::read);
    }

    /** Reads a record of {@code service.missionmanager}; the value may be null. */
    public static ParsedRequest<MissionCommand> mission(byte[] value) {
        return read(value, MissionCommand::read);
    }

    /** Reads a record of {@code service.replaymanager}; the value may be null. */
    public static ParsedRequest<ReplayCommand> replay(byte[] value) {
        return read(value, ReplayCommand::read);
    }

    /** Reads a record of {@code service.alarmmanager}; the value may be null. */
    public static ParsedRequest<AlarmCommand> alarm(byte[] value) {
        return read(value, AlarmCommand::read);
    }

    /** @param requestId may be null */
    public static byte[] write(String requestId, Command command) {
        ObjectNode json = NgsiJson.object().put("type", "request");
        DeviceGroup.put(json, "requestId", requestId);
        json.put("command", command.verb());
        command.describe(json);
        return NgsiJson.write(json);
    }

    /** Returns the answer to a valid command that was rejected. */
    public static CommandResult refusal(RejectedException refusal, Command command) {
        ObjectNode request = NgsiJson.object();
        command.describe(request);
        return aboutSubjects(CommandResult.rejected(refusal), request);
    }

    private static <C> ParsedRequest<C> read(byte[] value, Reader<C> reader) {
        if (value == null) {
            return new ParsedRequest.Passed<>();
        }
        JsonNode json;
        try {
            json = NgsiJson.read(value);
        } catch (UnreadableException e) {
            return rejected(ErrorCode.NOT_JSON, JsonObjectReader.quotable(e.getMessage()));
        }
        if ("response".equals(json.path("type").textValue())) {
            return new ParsedRequest.Passed<>();
        }
        if (!(json instanceof ObjectNode object)
                || !"request".equals(json.path("type").textValue())) {
            return rejected(ErrorCode.NOT_A_REQUEST, "it is not an object with type=request");
        }
        return read(object, reader);
    }

    private static <C> ParsedRequest<C> read(ObjectNode json, Reader<C> reader) {
        JsonObjectReader members = new JsonObjectReader(json);
        String requestId = null;
        try {
            requestId = requestId(members);
            JsonObjectReader.checkReadable(json);
            C command = reader.read(members.textOrNull("command"), members);
            Long ifSequence = members.has(IF_SEQUENCE) ? members.number(IF_SEQUENCE) : null;
            return new ParsedRequest.Request<>(requestId, command, ifSequence, members.flag(CommandResult.DRY_RUN));
        } catch (RejectedException e) {
            return new ParsedRequest.Refused<>(requestId, aboutSubjects(CommandResult.rejected(e), json));
        }
    }

    private static String requestId(JsonObjectReader members) throws RejectedException {
        String id = members.textOrNull("requestId");
        JsonObjectReader.refuseIf(
                id != null && !isRequestId(id), "requestId", "1 to 200 printable ASCII characters without spaces");
        return id;
    }

    /** Returns whether it is a legal request id; false for null. */
    static boolean isRequestId(String text) {
        return text != null && REQUEST_ID.matcher(text).matches();
    }

    private static <C> ParsedRequest<C> rejected(ErrorCode code, String reason) {
        return new ParsedRequest.Refused<>(null, CommandResult.rejected(new RejectedException(code, reason)));
    }

    static CommandResult aboutSubjects(CommandResult refusal, ObjectNode request) {
        CommandResult answer = refusal;
        for (String subject : SUBJECTS) {
            String name = request.path(subject).asText("");
            if (TopicName.isLegal(name) || ReplayCommand.REPLAY.matcher(name).matches()) {
                answer = answer.with(subject, name);
            }
        }
        return answer;
    }

    static RejectedException unknown(String verb, String commands) {
        return verb == null
                ? new RejectedException(
                        ErrorCode.MISSING_MEMBER, "the request needs a member 'command': one of " + commands)
                : new RejectedException(
                        ErrorCode.UNKNOWN_COMMAND,
                        "there is no command '%s' here, but %s".formatted(JsonObjectReader.quotable(verb), commands));
    }
}
