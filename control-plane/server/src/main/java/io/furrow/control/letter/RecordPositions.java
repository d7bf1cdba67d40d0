package io.furrow.control.letter;

import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.apache.kafka.common.TopicPartition;

/**
 * The place between two pages of records: an exclusive upper bound of offsets for each partition that has older ones. As text
 * {@code data.raw.dead:0=17,1=4;data.collision.dead:0=2}.
 */
public record RecordPositions(Map<TopicPartition, Long> ends) {
    private static final String TOPIC = "[A-Za-z0-9._-]{1,249}:[0-9]{1,9}=[0-9]{1,18}(,[0-9]{1,9}=[0-9]{1,18})*";
    private static final Pattern TEXT = Pattern.compile(TOPIC + "(;" + TOPIC + ")*");

    /** Parses the text; empty if it is invalid. */
    public static Optional<RecordPositions> of(String text) {
        if (!TEXT.matcher(text).matches()) {
            return Optional.empty();
        }
        Map<TopicPartition, Long> ends = new HashMap<>();
        for (String topic : text.split(";")) {
            int colon = topic.indexOf(':');
            String name = topic.substring(0, colon);
            for (String partition : topic.substring(colon + 1).split(",")) {
                String[] parts = partition.split("=");
                ends.put(new TopicPartition(name, Integer.parseInt(parts[0])), Long.parseLong(parts[1]));
            }
        }
        return Optional.of(new RecordPositions(ends));
    }

    public boolean isEmpty() {
        return ends.isEmpty();
    }

    @Override
    public String toString() {
        Map<String, Map<Integer, Long>> topics = new TreeMap<>();
        ends.forEach((partition, end) -> topics.computeIfAbsent(partition.topic(), topic -> new TreeMap<>())
                .put(partition.partition(), end));
        return topics.entrySet().stream()
                .map(topic -> topic.getKey() + ":"
                        + topic.getValue().entrySet().stream()
                                .map(end -> end.getKey() + "=" + end.getValue())
                                .collect(Collectors.joining(",")))
                .collect(Collectors.joining(";"));
    }
}
