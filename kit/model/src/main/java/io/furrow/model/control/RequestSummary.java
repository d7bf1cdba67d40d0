package io.furrow.model.control;

import java.io.IOException;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Reads the members that identify a request without parsing the rest, for requests that are too large or failed.
 *
 * @param json texts of at most {@value #MAX_LENGTH} characters; empty if the value is not a JSON object
 */
public record RequestSummary(ObjectNode json) {
    private static final int MAX_LENGTH = 200;
    private static final Set<String> MEMBERS =
            Set.of("type", "requestId", "command", "user", "domain", "mission", "replay", "alarm", "template");

    /** Reads until the first invalid JSON. */
    public static RequestSummary of(byte[] value) {
        ObjectNode json = NgsiJson.object();
        try (JsonParser parser = NgsiJson.mapper().getFactory().createParser(value)) {
            if (parser.nextToken() == JsonToken.START_OBJECT) {
                read(parser, json);
            }
        } catch (IOException e) {
            // The members before the invalid JSON are the summary.
        }
        return new RequestSummary(json);
    }

    private static void read(JsonParser parser, ObjectNode json) throws IOException {
        while (parser.nextToken() == JsonToken.FIELD_NAME) {
            String member = parser.currentName();
            JsonToken token = parser.nextToken();
            if (MEMBERS.contains(member) && token == JsonToken.VALUE_STRING && parser.getTextLength() <= MAX_LENGTH) {
                json.put(member, parser.getText());
            } else {
                parser.skipChildren();
            }
        }
    }

    public boolean isResponse() {
        return "response".equals(json.path("type").textValue());
    }

    /** Returns the request's id; null if it has no legal one. */
    public String requestId() {
        String id = json.path("requestId").textValue();
        return Requests.isRequestId(id) ? id : null;
    }

    /** Returns a rejection that names the subject of the request. */
    public CommandResult refusal(ErrorCode code, String reason) {
        return Requests.aboutSubjects(CommandResult.rejected(new RejectedException(code, reason)), json);
    }

    public byte[] toBytes() {
        return NgsiJson.write(json);
    }
}
