package io.furrow.analytics.field;

import java.nio.charset.StandardCharsets;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.field.FieldArea;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A record of {@code service.fields}: a change of a version.
 *
 * @param isTaken whether the version is removed
 * @param field null if the version is removed or ends the field
 */
record FieldVersionChange(FieldVersion.Key key, boolean isTaken, Field field) {
    /**
     * @throws UnreadableException if the record is not a version of a field, its area is invalid, or its key belongs to another
     *     version: compaction would then retain the wrong one
     */
    static FieldVersionChange read(TopicRecord record) throws UnreadableException {
        if (record.key() == null) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "the record has no key; it must be <field id>@<validFrom>");
        }
        FieldVersion.Key key = FieldVersion.Key.parse(new String(record.key(), StandardCharsets.UTF_8));
        if (record.value() == null) {
            return new FieldVersionChange(key, true, null);
        }
        FieldVersion version = FieldVersion.read(record.value());
        if (!version.key().equals(key.toString())) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "the key names " + key + ", the value is " + version.key());
        }
        return new FieldVersionChange(key, false, version.isEnd() ? null : field(version));
    }

    private static Field field(FieldVersion version) throws UnreadableException {
        return new Field(
                version.id(),
                version.validFrom(),
                version.name(),
                version.domain(),
                FieldArea.read(version.geometry(), "field " + version.key()));
    }
}
