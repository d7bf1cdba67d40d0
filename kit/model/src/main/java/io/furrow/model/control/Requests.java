package io.furrow.model.control;

import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.TopicName;

/**
 * Requests to and from JSON. Reading never throws: what cannot be understood is {@link ParsedRequest.Refused} with a code and a
 * sentence. Members of names that no command has are skipped, because older clients send more than is asked for.
 */
public final class Requests {
    private static final Pattern REQUEST_ID = Pattern.compile("[!-~]{1,200}");
    /** Members that an error answers with, so that a client without request ids knows what it is about. */
    private static final List<String> SUBJECTS = List.of("domain", "mission", "replay", "group", "alarm");

    private Requests() {}

    /** Makes a command of a request's members. */
    private interface Reader<C> {
        C read(String verb, JsonObjectReader members) throws RejectedException;
    }

    /** A record of {@code service.domainmanager}; the value may be null. */
    public static ParsedRequest<DomainCommand> domain(byte[] value) {
        return read(value, DomainCommand::read);
    }

    /** A record of {@code service.missionmanager}; the value may be null. */
    public static ParsedRequest<MissionCommand> mission(byte[] value) {
        return read(value, MissionCommand::read);
    }

    /** A record of {@code service.replaymanager}; the value may be null. */
    public static ParsedRequest<ReplayCommand> replay(byte[] value) {
        return read(value, ReplayCommand::read);
    }

    /** A record of {@code service.alarmmanager}; the value may be null. */
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

    /** The answer to a command that was understood and not granted. */
    public static CommandResult refusal(RejectedException refusal, Command command) {
        ObjectNode request = NgsiJson.object();
        command.describe(request);
        return aboutSubjects(CommandResult.refused(refusal), request);
    }

    private static <C> ParsedRequest<C> read(byte[] value, Reader<C> reader) {
        if (value == null) {
            return new ParsedRequest.Passed<>();
        }
        JsonNode json;
        try {
            json = NgsiJson.read(value);
        } catch (UnreadableException e) {
            return refused(ErrorCode.NOT_JSON, JsonObjectReader.quotable(e.getMessage()));
        }
        if ("response".equals(json.path("type").textValue())) {
            return new ParsedRequest.Passed<>();
        }
        if (!(json instanceof ObjectNode object)
                || !"request".equals(json.path("type").textValue())) {
            return refused(ErrorCode.NOT_A_REQUEST, "it is not an object with type=request");
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
            return new ParsedRequest.Request<>(requestId, command);
        } catch (RejectedException e) {
            return new ParsedRequest.Refused<>(requestId, aboutSubjects(CommandResult.refused(e), json));
        }
    }

    private static String requestId(JsonObjectReader members) throws RejectedException {
        String id = members.textOrNull("requestId");
        JsonObjectReader.refuseIf(
                id != null && !isRequestId(id), "requestId", "1 to 200 printable ASCII characters without spaces");
        return id;
    }

    /** Whether it is a legal id of a request; null is none. */
    static boolean isRequestId(String text) {
        return text != null && REQUEST_ID.matcher(text).matches();
    }

    private static <C> ParsedRequest<C> refused(ErrorCode code, String reason) {
        return new ParsedRequest.Refused<>(null, CommandResult.refused(new RejectedException(code, reason)));
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

    static RejectedException unknown(String verb, String known) {
        return verb == null
                ? new RejectedException(
                        ErrorCode.MISSING_MEMBER, "the request needs a member 'command': one of " + known)
                : new RejectedException(
                        ErrorCode.UNKNOWN_COMMAND,
                        "there is no command '%s' here, but %s".formatted(JsonObjectReader.quotable(verb), known));
    }
}
