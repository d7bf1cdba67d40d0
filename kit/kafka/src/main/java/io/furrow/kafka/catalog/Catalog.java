package io.furrow.kafka.catalog;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.kafka.CommittedReader;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads the topic {@code data.catalog} to its end. */
public final class Catalog {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);

    private Catalog() {}

    /**
     * The newest entry of each tenant, domain, mission and type, in this order; empty without the topic.
     *
     * @throws IOException if the topic holds something else; the message says what to do
     * @throws org.apache.kafka.common.KafkaException if Kafka does not answer
     */
    public static List<JsonNode> read(Properties client) throws IOException {
        Properties properties = new Properties();
        properties.putAll(client);
        properties.setProperty("default.api.timeout.ms", Long.toString(TIMEOUT.toMillis()));
        Map<String, byte[]> newest = new TreeMap<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(properties, Topics.CATALOG)) {
            reader.readToEnd(record -> {
                if (record.value() == null) {
                    newest.remove(record.key());
                } else {
                    newest.put(record.key(), record.value());
                }
            });
        }
        List<JsonNode> entries = new ArrayList<>();
        for (Map.Entry<String, byte[]> one : newest.entrySet()) {
            entries.add(entry(one.getKey(), one.getValue()));
        }
        return entries;
    }

    /** Returns whether an entry is of a domain and a mission; null for any. An entry without a domain is of each. */
    public static boolean isOf(JsonNode entry, String domain, String mission) {
        boolean isOfDomain =
                domain == null || domain.equals(entry.path("domain").asText(domain));
        return isOfDomain
                && (mission == null || mission.equals(entry.path("mission").asText()));
    }

    private static JsonNode entry(String key, byte[] value) throws IOException {
        try {
            return NgsiJson.read(value);
        } catch (UnreadableException e) {
            throw new IOException(
                    "%s holds something else than a catalog at key %s. Check who else writes to it."
                            .formatted(Topics.CATALOG, key),
                    e);
        }
    }
}
