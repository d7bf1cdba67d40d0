package io.furrow.model.control;

import java.io.IOException;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * The members of a request that say whose it is and what it is about, read without the rest: for requests that are too large, or that
 * could not be carried out.
 *
 * @param json texts of at most {@value #MAX_LENGTH} characters; empty if the value is not a JSON object
 */
public record RequestSummary(ObjectNode json) {
    private static final int MAX_LENGTH = 200;
    private static final Set<String> MEMBERS =
            Set.of("type", "requestId", "command", "user", "domain", "mission", "replay", "alarm", "template");

    /** Reads as far as the value is JSON. */
    public static RequestSummary of(byte[] value) {
        ObjectNode json = NgsiJson.object();
        try (JsonParser parser = NgsiJson.mapper().getFactory().createParser(value)) {
            if (parser.nextToken() == JsonToken.START_OBJECT) {
                read(parser, json);
            }
        } catch (IOException e) {
            // What was read until then is the excerpt: nobody can say more of such a request.
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

    /** Null if the request has none that is legal. */
    public String requestId() {
        String id = json.path("requestId").textValue();
        return Requests.isRequestId(id) ? id : null;
    }

    /** A refusal that names what the request is about. */
    public CommandResult refusal(ErrorCode code, String reason) {
        return Requests.aboutSubjects(CommandResult.refused(new RejectedException(code, reason)), json);
    }

    public byte[] toBytes() {
        return NgsiJson.write(json);
    }
}
