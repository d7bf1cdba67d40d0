package io.furrow.bench.component;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

/** A component with its own bench, in a short variant of about half a minute, and the peers measured beside it. */
public enum Component {
    SOURCE(
            "NGSI source: notifications in Kafka",
            "notifications --runs 1 --seconds 8 --warmup 8 --calibration 3",
            "/median/inKafkaPerSecond",
            new Peer("bare producer", "/median/bareProducerPerSecond"),
            new Peer("bare bridge from HTTP to Kafka", "/median/bareBridgePerSecond"),
            new Peer("bare HTTP server", "/median/bareServerPerSecond")),
    SINK(
            "NGSI sink: updates",
            "sink --runs 1",
            "/0/medianUpdatesPerSecond",
            new Peer("bare HTTP server", "/0/runs/0/bareServerEntitiesPerSecond")),
    INGEST(
            "ingest: records",
            "ingest --turns 1 --records 300000 --delivery at-least-once --jobs COPY_TWICE,INGEST",
            "/runs/1/recordsPerSecond",
            new Peer("job that copies", "/runs/0/recordsPerSecond")),
    COLLISION(
            "collision: positions",
            "analytics --parts MEMORY --devices 10000 --cores 2 --warmup 10 --seconds 10",
            "/memory/0/updates~1s",
            new Peer("bare loop", "/memory/0/bare loop"),
            new Peer("Redis GEO", "/memory/0/Redis GEO")),
    REPLAY(
            "replay at max: events",
            "replay --max --events 30000 --turns 1",
            "/0/0/events~1s",
            new Peer("bare cursor, the same queries", "/0/1/events~1s"),
            new Peer("bare cursor, one query", "/0/2/events~1s"));

    private final String title;
    private final List<String> words;
    private final String figure;
    private final Peer peer;
    private final List<Peer> others;

    /** @param others further peers; one that is not installed has no figure */
    Component(String title, String words, String figure, Peer peer, Peer... others) {
        this.title = title;
        this.words = List.of(words.split(" "));
        this.figure = figure;
        this.peer = peer;
        this.others = List.of(others);
    }

    /** A peer of a component. */
    private record Peer(String name, String figure) {}

    /** The unit counted per second. */
    String title() {
        return title;
    }

    String peer() {
        return peer.name;
    }

    /** Medians of the further peers by name; NaN if no turn has a figure, such as for one that is not installed. */
    Map<String, Double> others(List<Rates> turns) {
        Map<String, Double> medians = new LinkedHashMap<>();
        for (Peer other : others) {
            List<Rates> its = turns.stream()
                    .filter(turn -> turn.others().containsKey(other.name))
                    .toList();
            medians.put(other.name, Comparison.median(its, turn -> turn.others().get(other.name)));
        }
        return medians;
    }

    /** The arguments of {@code ./furrow bench}. */
    public List<String> words() {
        return words;
    }

    /** @param output of the bench's {@code --output} */
    Rates rates(JsonNode output) {
        Map<String, Double> further = new LinkedHashMap<>();
        others.stream()
                .filter(other -> output.at(other.figure).isNumber())
                .forEach(other -> further.put(other.name, number(output, other.figure)));
        return new Rates(number(output, figure), number(output, peer.figure), further);
    }

    private double number(JsonNode output, String pointer) {
        JsonNode found = output.at(pointer);
        if (!found.isNumber()) {
            throw new IllegalStateException(
                    "the bench %s has no figure at %s: %s".formatted(words.get(0), pointer, output));
        }
        return found.doubleValue();
    }

    /**
     * Rates per second, of the component and of its peers in the same minute.
     *
     * @param peers of the reference peer for shares
     * @param others by name, of the further peers
     */
    record Rates(double ours, double peers, Map<String, Double> others) {
        Rates {
            others = others == null ? Map.of() : others;
        }

        double share() {
            return ours / peers;
        }
    }
}
