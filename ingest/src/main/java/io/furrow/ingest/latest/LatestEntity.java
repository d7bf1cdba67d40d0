package io.furrow.ingest.latest;

import java.nio.charset.StandardCharsets;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.SortedMap;
import java.util.TreeMap;

import com.fasterxml.jackson.core.io.JsonStringEncoder;

import io.furrow.model.ngsi.SlicedEntity;

/**
 * The newest that is known of an entity. An attribute changes by events that are not older than what is known of it; of two
 * events of one time the later to arrive stands.
 *
 * @param time of the newest event, epoch ms
 * @param deleted whether that event was its deletion; nothing older brings it back
 * @param type as the newest event had it
 * @param received when the last event was received, epoch ms; before {@code time} if the device's clock is ahead
 */
public record LatestEntity(
        long time, boolean deleted, String type, Map<String, LatestAttribute> attributes, long received) {
    /** A device that makes up names of attributes would otherwise fill the memory, and no topic would take the record. */
    private static final int MAX_ATTRIBUTES = 1000;

    static final LatestEntity NEVER_SEEN = new LatestEntity(Long.MIN_VALUE, false, "", Map.of(), Long.MIN_VALUE);

    /**
     * After a change: the same object where the event brings nothing that is not known newer. Else this one is of no more use, as
     * the other takes over its attributes. Of more attributes than are kept, and than the event brings, those that were reported
     * longest ago go.
     */
    LatestEntity with(SlicedEntity reported, long eventTime, long eventReceived) {
        if (deleted && eventTime <= time) {
            return this;
        }
        Map<String, LatestAttribute> merged =
                deleted ? new TreeMap<>() : attributes instanceof TreeMap ? attributes : new TreeMap<>(attributes);
        boolean news = eventTime >= time;
        List<SlicedEntity.Slice> changes = reported.attributes();
        for (SlicedEntity.Slice attribute : changes) {
            LatestAttribute known = merged.get(attribute.name());
            if (known == null || known.time() <= eventTime) {
                merged.put(attribute.name(), new LatestAttribute(eventTime, attribute.json()));
                news = true;
            }
        }
        int excess = merged.size() - Math.max(MAX_ATTRIBUTES, changes.size());
        if (news && excess > 0) {
            List<String> oldest = merged.entrySet().stream()
                    .sorted(Comparator.comparingLong(each -> each.getValue().time()))
                    .limit(excess)
                    .map(Map.Entry::getKey)
                    .toList();
            oldest.forEach(merged::remove);
        }
        return news
                ? new LatestEntity(
                        Math.max(time, eventTime),
                        false,
                        eventTime >= time ? reported.type() : type,
                        merged,
                        Math.max(received, eventReceived))
                : this;
    }

    /**
     * After its deletion: the same object where something newer is known. The time of a deletion is that of the context
     * broker or of its receipt: of a device whose clock is ahead the receipt of its events counts.
     */
    LatestEntity withoutAnything(long eventTime) {
        return eventTime >= Math.min(time, received)
                ? new LatestEntity(Math.max(time, eventTime), true, type, Map.of(), eventTime)
                : this;
    }

    LatestEntity ofType(String other) {
        return new LatestEntity(time, deleted, other, attributes, received);
    }

    /** In normalized form, attributes by name; put together from what is JSON already. */
    byte[] toBytes(String id) {
        StringBuilder json = new StringBuilder("{\"id\":").append(quoted(id));
        json.append(",\"type\":").append(quoted(type));
        Map<String, LatestAttribute> byName = attributes instanceof SortedMap ? attributes : new TreeMap<>(attributes);
        for (Map.Entry<String, LatestAttribute> attribute : byName.entrySet()) {
            json.append(',').append(quoted(attribute.getKey())).append(':');
            json.append(attribute.getValue().json());
        }
        return json.append('}').toString().getBytes(StandardCharsets.UTF_8);
    }

    private static StringBuilder quoted(String text) {
        return new StringBuilder(text.length() + 2)
                .append('"')
                .append(JsonStringEncoder.getInstance().quoteAsString(text))
                .append('"');
    }
}
