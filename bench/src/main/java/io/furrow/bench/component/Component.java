package io.furrow.bench.component;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

/** A component with a bench of its own, in a form of some half a minute, and the peer that is measured beside it. */
public enum Component {
    SOURCE(
            "NGSI source: notifications in Kafka",
            List.of("notifications", "--runs", "1", "--seconds", "10", "--warmup", "10", "--calibration", "5"),
            "/median/inKafkaPerSecond",
            "bare producer",
            "/median/bareProducerPerSecond"),
    SINK(
            "NGSI sink: updates",
            List.of("sink", "--runs", "1"),
            "/0/medianUpdatesPerSecond",
            "bare HTTP server",
            "/0/runs/0/bareServerEntitiesPerSecond"),
    INGEST(
            "ingest: records",
            List.of(
                    "ingest",
                    "--turns",
                    "1",
                    "--records",
                    "300000",
                    "--delivery",
                    "at-least-once",
                    "--jobs",
                    "COPY_TWICE,INGEST"),
            "/runs/1/recordsPerSecond",
            "job that copies",
            "/runs/0/recordsPerSecond"),
    COLLISION(
            "collision: positions",
            List.of(
                    "analytics",
                    "--parts",
                    "MEMORY",
                    "--devices",
                    "10000",
                    "--cores",
                    "2",
                    "--warmup",
                    "10",
                    "--seconds",
                    "10"),
            "/memory/0/updates~1s",
            "bare loop",
            "/memory/0/bare loop"),
    REPLAY(
            "replay at max: events",
            List.of("replay", "--max", "--events", "100000", "--turns", "1"),
            "/0/0/events~1s",
            "bare cursor",
            "/0/2/events~1s");

    private final String title;
    private final List<String> words;
    private final String figure;
    private final String peer;
    private final String peerFigure;

    Component(String title, List<String> words, String figure, String peer, String peerFigure) {
        this.title = title;
        this.words = words;
        this.figure = figure;
        this.peer = peer;
        this.peerFigure = peerFigure;
    }

    /** What is counted, a second. */
    public String title() {
        return title;
    }

    public String peer() {
        return peer;
    }

    /** Of {@code ./furrow bench}. */
    public List<String> words() {
        return words;
    }

    /** @param output what the bench wrote with {@code --output} */
    public Rates rates(JsonNode output) {
        return new Rates(number(output, figure), number(output, peerFigure));
    }

    private double number(JsonNode output, String pointer) {
        JsonNode found = output.at(pointer);
        if (!found.isNumber()) {
            throw new IllegalStateException(
                    "the bench %s has no figure at %s: %s".formatted(words.get(0), pointer, output));
        }
        return found.doubleValue();
    }

    /** A second, of the component and of its peer in the same minute. */
    public record Rates(double ours, double peers) {
        public double share() {
            return ours / peers;
        }
    }
}
