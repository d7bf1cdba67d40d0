package io.furrow.kafka.catalog;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads the topic {@code data.catalog} to its end. */
public final class Catalog {
    private static final Logger LOG = LoggerFactory.getLogger(Catalog.class);
    private static final Duration TIMEOUT = Duration.ofSeconds(10);

    private Catalog() {}

    /**
     * The newest entry of each tenant, domain, mission and type, in this order; empty without the topic. Of records that are no
     * entries the log has the number and a key.
     *
     * @throws org.apache.kafka.common.KafkaException if Kafka does not answer
     */
    public static List<JsonNode> read(Properties client) {
        Properties properties = new Properties();
        properties.putAll(client);
        properties.setProperty("default.api.timeout.ms", Long.toString(TIMEOUT.toMillis()));
        Map<String, byte[]> newest = new TreeMap<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(properties, Topics.CATALOG)) {
            reader.readToEnd(record -> newest.put(Objects.requireNonNullElse(record.key(), ""), record.value()));
        }
        newest.values().removeIf(Objects::isNull);
        List<JsonNode> entries = new ArrayList<>();
        List<String> others = new ArrayList<>();
        newest.forEach((key, value) -> entry(value).ifPresentOrElse(entries::add, () -> others.add(key)));
        if (!others.isEmpty()) {
            LOG.warn(
                    "{} records of {} are no entries, one with the key '{}'; find out who else writes there",
                    others.size(),
                    Topics.CATALOG,
                    others.get(0));
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

    private static Optional<JsonNode> entry(byte[] value) {
        try {
            return Optional.of(NgsiJson.read(value))
                    .filter(entry -> entry.path("mission").isTextual()
                            && entry.path("type").isTextual());
        } catch (UnreadableException e) {
            return Optional.empty();
        }
    }
}
