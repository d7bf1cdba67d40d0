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
 * The newest state of an entity. An event changes an attribute if it is not older than the attribute's state; of two events with
 * equal times the last to arrive wins.
 *
 * @param time of the newest event, epoch ms
 * @param deleted whether that event was its deletion, which no older event reverts
 * @param type in the newest event
 * @param received when the last event was received, epoch ms; before {@code time} if the device's clock is ahead
 */
public record LatestEntity(
        long time, boolean deleted, String type, Map<String, LatestAttribute> attributes, long received) {
    /** Limits the memory, and the record size, that a device with generated names of attributes can cause. */
    private static final int MAX_ATTRIBUTES = 1000;

    static final LatestEntity NEVER_SEEN = new LatestEntity(Long.MIN_VALUE, false, "", Map.of(), Long.MIN_VALUE);

    /**
     * Applies a change: returns the same object if the event is outdated. Otherwise this object must not be used any more,
     * because the result takes over its attributes. Above the limit, or the number of the event's attributes, those reported
     * longest ago are dropped.
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
     * Applies a deletion: returns the same object if it is outdated. The time of a deletion is that of the context broker or of
     * its receipt; if the device's clock is ahead, it is compared with the receipt of its events.
     */
    LatestEntity withoutAnything(long eventTime) {
        return eventTime >= Math.min(time, received)
                ? new LatestEntity(Math.max(time, eventTime), true, type, Map.of(), eventTime)
                : this;
    }

    LatestEntity ofType(String other) {
        return new LatestEntity(time, deleted, other, attributes, received);
    }

    /** In normalized form, attributes by name; concatenated from existing JSON. */
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
