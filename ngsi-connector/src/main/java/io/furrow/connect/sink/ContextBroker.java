package io.furrow.connect.sink;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.connect.sink.EntityUpdates.Update;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/** Writes entities into a context broker with {@code POST /v2/op/update}, action {@code append}. */
final class ContextBroker {
    /** What became of a request. */
    sealed interface Outcome {
        /** The entities are in the context broker. */
        record Written() implements Outcome {}

        /** The context broker does not take these entities; {@code words} are its status and its reason. */
        record Refused(String words) implements Outcome {}

        /** There was no answer, or one that says to come again: the same request may succeed later. */
        record Away(String reason, Throwable cause) implements Outcome {}

        /** What answered is no context broker for this caller: no request can succeed until a setting is changed. */
        record WrongSetting(String words) implements Outcome {}
    }

    private static final int LONGEST_WORDS = 1000;

    private final HttpClient client;
    private final URI update;
    private final Duration timeout;

    /**
     * @param base for instance {@code http://orion:1026}
     * @param timeout for one request, from its start to the whole answer
     */
    ContextBroker(URI base, Duration timeout) {
        this.client = HttpClient.newBuilder()
                .version(HttpClient.Version.HTTP_1_1)
                .connectTimeout(timeout)
                .build();
        String text = base.toString();
        this.update = URI.create((text.endsWith("/") ? text.substring(0, text.length() - 1) : text) + "/v2/op/update");
        this.timeout = timeout;
    }

    /** Writes entities of one scope; an interrupt while it waits stays set and counts as {@link Outcome.Away}. */
    Outcome append(FiwareScope scope, List<Update> updates) {
        try {
            HttpRequest request = request(scope, updates);
            HttpResponse<String> answer = client.send(request, HttpResponse.BodyHandlers.ofString());
            return outcome(answer.statusCode(), answer.body());
        } catch (IOException e) {
            return new Outcome.Away(update + " does not answer: " + e, e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return new Outcome.Away("interrupted while waiting for " + update, e);
        }
    }

    private HttpRequest request(FiwareScope scope, List<Update> updates) {
        ObjectNode body = JsonNodeFactory.instance.objectNode().put("actionType", "append");
        ArrayNode entities = body.putArray("entities");
        updates.forEach(update -> entities.add(update.entity()));
        HttpRequest.Builder request = HttpRequest.newBuilder(update)
                .timeout(timeout)
                .header("Content-Type", "application/json")
                .header("Fiware-Servicepath", scope.servicePath())
                .POST(HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(body)));
        if (!scope.service().isEmpty()) {
            request.header("Fiware-Service", scope.service());
        }
        return request.build();
    }

    private Outcome outcome(int status, String body) {
        String words = status + " " + (body.length() > LONGEST_WORDS ? body.substring(0, LONGEST_WORDS) + "…" : body);
        return switch (status) {
            case 408, 425, 429 -> new Outcome.Away(update + " answered " + words, null);
            case 401, 403, 404, 405 -> new Outcome.WrongSetting(update + " answered " + words);
            default -> outcomeOfClass(status / 100, words);
        };
    }

    private Outcome outcomeOfClass(int statusClass, String words) {
        return switch (statusClass) {
            case 2 -> new Outcome.Written();
            case 4 -> new Outcome.Refused(words);
            case 5 -> new Outcome.Away(update + " answered " + words, null);
            default -> new Outcome.WrongSetting(update + " answered " + words);
        };
    }
}
