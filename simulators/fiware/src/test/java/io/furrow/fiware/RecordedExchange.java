package io.furrow.fiware;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** A line of {@code fiware-rest/exchanges.jsonl}: a request, and what Orion 4.7 or IoT Agent JSON 3.14 answered. */
record RecordedExchange(int line, JsonNode json) {
    private static final String FOLDER = "/fiware-rest/";

    /** An answer with neutral ids, dates and addresses; null for a header that is not there. */
    record Answer(int status, String location, String totalCount, String body) {}

    static List<RecordedExchange> all() throws IOException {
        List<RecordedExchange> all = new ArrayList<>();
        try (BufferedReader lines = new BufferedReader(new InputStreamReader(resource("exchanges.jsonl"), UTF_8))) {
            for (String line = lines.readLine(); line != null; line = lines.readLine()) {
                all.add(new RecordedExchange(all.size() + 1, NgsiJson.mapper().readTree(line)));
            }
        }
        return all;
    }

    /** The parts in which the stand-in differs on purpose, by line. */
    static Map<Integer, Set<String>> namedDifferences() throws IOException {
        Map<Integer, Set<String>> named = new LinkedHashMap<>();
        try (InputStream in = resource("differences.json")) {
            for (JsonNode difference : NgsiJson.mapper().readTree(in)) {
                Set<String> parts = new TreeSet<>();
                difference.required("parts").forEach(part -> parts.add(part.asText()));
                if (parts.isEmpty() || difference.required("reason").asText().isBlank()) {
                    throw new IllegalArgumentException("a difference without parts or reason: " + difference);
                }
                if (named.put(difference.required("line").asInt(), parts) != null) {
                    throw new IllegalArgumentException("a line that is named twice: " + difference);
                }
            }
        }
        return named;
    }

    private static InputStream resource(String name) {
        return Objects.requireNonNull(RecordedExchange.class.getResourceAsStream(FOLDER + name), name);
    }

    boolean isForContextBroker() {
        return json.required("to").asText().equals("context-broker");
    }

    String method() {
        return json.required("method").asText();
    }

    String path() {
        return json.required("path").asText();
    }

    /** Empty for none. */
    String body() {
        JsonNode request = json.required("request");
        return request.isNull() ? "" : request.isTextual() ? request.textValue() : request.toString();
    }

    Map<String, String> headers() {
        Map<String, String> headers = new LinkedHashMap<>();
        json.required("headers")
                .properties()
                .forEach(
                        header -> headers.put(header.getKey(), header.getValue().asText()));
        return headers;
    }

    /** The parts in which an answer differs from the recorded one. */
    Set<String> differences(Answer answer) {
        Set<String> parts = new TreeSet<>();
        if (answer.status() != json.required("status").asInt()) {
            parts.add("status");
        }
        if (!Objects.equals(answer.location(), json.required("location").textValue())) {
            parts.add("location");
        }
        if (!Objects.equals(answer.totalCount(), json.required("totalCount").textValue())) {
            parts.add("totalCount");
        }
        if (!comparable(answer.body()).equals(comparable(json.required("answer").textValue()))) {
            parts.add("body");
        }
        return parts;
    }

    /** JSON without regard to the order of members, and without the registry's own numbers; else the text. */
    private static Object comparable(String body) {
        try {
            JsonNode tree = NgsiJson.read(body.getBytes(UTF_8));
            tree.findParents("creationDate")
                    .forEach(
                            group -> ((ObjectNode) group).put("creationDate", 0).put("_id", 0));
            return tree;
        } catch (UnreadableException e) { // HTML, or nothing
            return body;
        }
    }

    @Override
    public String toString() {
        return "%d %s %s %s".formatted(line, json.path("to").asText(), method(), path());
    }
}
