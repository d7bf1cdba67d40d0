package io.furrow.simulators.host;

import java.util.HashMap;
import java.util.Map;
import java.util.TreeMap;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.robot.WorkField;

/** The fields of {@code service.fields}, by version. Of a field with several parts devices use the largest. */
final class FieldCache {
    private static final Logger LOG = LoggerFactory.getLogger(FieldCache.class);

    private final Map<String, FieldVersion> versions = new HashMap<>();

    /** Processes records, null for a removed version. */
    void take(Map<String, byte[]> records) {
        records.forEach((key, value) -> {
            try {
                versions.remove(key);
                if (value != null) {
                    versions.put(key, FieldVersion.read(value));
                }
            } catch (UnreadableException e) {
                LOG.warn("the field of {} cannot be read and is ignored: {}", key, e.getMessage());
            }
        });
    }

    /** The fields valid at an event time, by id. */
    Map<String, WorkField> at(long time) {
        Map<String, FieldVersion> newest = new HashMap<>();
        for (FieldVersion version : versions.values()) {
            if (version.validFrom() <= time) {
                newest.merge(version.id(), version, (a, b) -> a.validFrom() > b.validFrom() ? a : b);
            }
        }
        Map<String, WorkField> fields = new TreeMap<>();
        newest.forEach((id, version) -> {
            try {
                if (!version.isEnd()) {
                    fields.put(id, WorkField.largestOf(id, version.geometry()));
                }
            } catch (IllegalArgumentException e) {
                LOG.warn("field {} is not used, because no device can be in it: {}", id, e.getMessage());
            }
        });
        return fields;
    }
}
