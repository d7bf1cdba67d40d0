package io.furrow.fields;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The effect of a field version compared with the existing versions.
 *
 * @param version the version to write; not written if {@link Kind#UNCHANGED}
 */
public record FieldChange(Kind kind, FieldVersion version) {
    /** How the version differs from the one valid at that time. */
    public enum Kind {
        ADDED,
        CHANGED,
        UNCHANGED,
        ENDED
    }

    /**
     * Returns the change for each version, in order; then, if they {@code replace} all, the end of each field that is
     * not among them.
     *
     * @param known every version of {@code service.fields}
     * @param validFrom end of the fields that are not among them, epoch ms
     */
    public static List<FieldChange> of(
            List<FieldVersion> versions, List<FieldVersion> known, boolean replace, long validFrom) {
        List<FieldChange> changes = new ArrayList<>();
        for (FieldVersion version : versions) {
            changes.add(new FieldChange(kind(version, known), version));
        }
        if (replace) {
            Set<String> kept = versions.stream().map(FieldVersion::id).collect(Collectors.toSet());
            asOf(validFrom, known).values().stream()
                    .filter(field -> !kept.contains(field.id()))
                    .map(field -> new FieldVersion(field.id(), validFrom, null, JsonNodeFactory.instance.objectNode()))
                    .forEach(end -> changes.add(new FieldChange(Kind.ENDED, end)));
        }
        return changes;
    }

    /** Returns the fields valid at a time, by id. */
    public static Map<String, FieldVersion> asOf(long time, List<FieldVersion> known) {
        Map<String, FieldVersion> fields = new TreeMap<>();
        known.stream()
                .filter(version -> version.validFrom() <= time)
                .sorted(Comparator.comparingLong(FieldVersion::validFrom))
                .forEach(version -> fields.put(version.id(), version));
        fields.values().removeIf(FieldVersion::isEnd);
        return fields;
    }

    private static Kind kind(FieldVersion version, List<FieldVersion> known) {
        return Optional.ofNullable(asOf(version.validFrom(), known).get(version.id()))
                .map(before -> isSame(before, version) ? Kind.UNCHANGED : Kind.CHANGED)
                .orElse(Kind.ADDED);
    }

    /** Compares versions as read back from JSON, so that 1 and 1.0 are normalized as on the topic. */
    private static boolean isSame(FieldVersion one, FieldVersion other) {
        FieldVersion before = readBack(one);
        FieldVersion now = readBack(other);
        return before.geometry().equals(now.geometry()) && before.properties().equals(now.properties());
    }

    private static FieldVersion readBack(FieldVersion version) {
        try {
            return FieldVersion.read(version.toBytes());
        } catch (UnreadableException e) {
            throw new IllegalStateException("the JSON of a field version cannot be read back: " + version.key(), e);
        }
    }
}
