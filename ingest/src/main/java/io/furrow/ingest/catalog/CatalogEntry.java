package io.furrow.ingest.catalog;

import java.time.Instant;
import java.util.HashMap;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.ingest.route.EventEntity;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.SlicedEntity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The catalog entry of one type of entity in one mission: counts, times, and a profile of each attribute. Entries of the same
 * key can be merged in any order.
 *
 * @param service tenant; empty for the default one
 * @param domain empty if there is none
 * @param mission empty if there is none
 * @param entities number of entities seen and not deleted
 * @param events number of reported changes
 * @param bytes of these events, without images that were moved to files
 * @param images number of images moved to files
 * @param first event time of the first event, epoch ms
 * @param last event time of the last event, epoch ms
 * @param attributes by name, at most {@value #MAX_ATTRIBUTES}
 */
public record CatalogEntry(
        String service,
        String domain,
        String mission,
        String type,
        long entities,
        long events,
        long bytes,
        long images,
        long imageBytes,
        long first,
        long last,
        Map<String, AttributeProfile> attributes) {
    /** Limits the memory that a device with generated names can use. */
    static final int MAX_ATTRIBUTES = 1000;

    private static final double MILLIS_PER_SECOND = 1000;

    /** The entry of one event. */
    static CatalogEntry of(ReportedEvent event) throws UnreadableException {
        SlicedEntity entity = EventEntity.of(event.record());
        Map<String, AttributeProfile> attributes = new HashMap<>();
        long images = 0;
        long imageBytes = 0;
        for (SlicedEntity.Slice attribute : entity.attributes()) {
            var profile = AttributeProfile.of(attribute, event.time());
            if (profile.isEmpty() || Entity.BUILT_INS.contains(attribute.name())) {
                continue;
            }
            if (attributes.size() < MAX_ATTRIBUTES) {
                attributes.put(attribute.name(), profile.get());
            }
            if (profile.get().kind().equals(AttributeProfile.IMAGE)) {
                images++;
                imageBytes += attribute.tree().path("bytes").asLong();
            }
        }
        return new CatalogEntry(
                service(event),
                event.domain(),
                event.mission(),
                entity.type(),
                0,
                1,
                event.record().value().length,
                images,
                imageBytes,
                event.time(),
                event.time(),
                attributes);
    }

    private static String service(ReportedEvent event) {
        Map<String, String> headers = event.record().headers();
        return FiwareScope.of(headers).service();
    }

    /** Adds a number of entities, which may be negative. */
    CatalogEntry andEntities(long more) {
        return new CatalogEntry(
                service,
                domain,
                mission,
                type,
                entities + more,
                events,
                bytes,
                images,
                imageBytes,
                first,
                last,
                attributes);
    }

    /** An entry with only a number of entities. */
    CatalogEntry onlyEntities(long number) {
        return new CatalogEntry(service, domain, mission, type, number, 0, 0, 0, 0, first, last, new HashMap<>());
    }

    /** Tenant, domain, mission and type as one unambiguous text. */
    String key() {
        return String.join("|", escaped(service), escaped(domain), escaped(mission), escaped(type));
    }

    private static String escaped(String part) {
        return part.replace("%", "%25").replace("|", "%7C");
    }

    /** Merges both. */
    CatalogEntry plus(CatalogEntry other) {
        Map<String, AttributeProfile> all = new HashMap<>(attributes);
        other.attributes.forEach((name, profile) -> {
            if (all.containsKey(name) || all.size() < MAX_ATTRIBUTES) {
                all.merge(name, profile, AttributeProfile::plus);
            }
        });
        return new CatalogEntry(
                service,
                domain,
                mission,
                type,
                entities + other.entities,
                events + other.events,
                bytes + other.bytes,
                images + other.images,
                imageBytes + other.imageBytes,
                Math.min(first, other.first),
                Math.max(last, other.last),
                all);
    }

    /**
     * The value on {@code data.catalog}; times in ISO 8601, rates per second.
     *
     * @param deleted event time of the deletion of its last entity, epoch ms; null while it has entities
     */
    byte[] toBytes(Long deleted) {
        ObjectNode json = NgsiJson.mapper()
                .createObjectNode()
                .put("service", service)
                .put("domain", domain)
                .put("mission", mission)
                .put("type", type)
                .put("entities", Math.max(0, entities))
                .put("events", events)
                .put("bytes", bytes)
                .put("images", images)
                .put("imageBytes", imageBytes);
        writeTimes(json, events, first, last);
        if (deleted != null) {
            json.put("deleted", Instant.ofEpochMilli(deleted).toString());
        }
        ObjectNode byName = json.putObject("attributes");
        new TreeMap<>(attributes).forEach((name, profile) -> profile.writeTo(byName.putObject(name)));
        return NgsiJson.write(json);
    }

    /** First and last time, and the rate per second between them; no rate if they are equal. */
    static void writeTimes(ObjectNode json, long count, long first, long last) {
        json.put("first", Instant.ofEpochMilli(first).toString())
                .put("last", Instant.ofEpochMilli(last).toString());
        if (last > first) {
            json.put("rate", Math.round((count - 1) * MILLIS_PER_SECOND * 1e6 / (last - first)) / 1e6);
        }
    }
}
