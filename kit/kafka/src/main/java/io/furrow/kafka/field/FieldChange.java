package io.furrow.kafka.field;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Predicate;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

/**
 * The effect of a field version compared with the existing versions.
 *
 * @param version the version to write; not written if {@link Kind#UNCHANGED}
 * @param before the version valid at that time; null if there is none
 */
public record FieldChange(Kind kind, FieldVersion version, FieldVersion before) {
    /** Ends no field. */
    public static final Predicate<FieldVersion> NONE = field -> false;

    /** The difference from the version valid at that time. */
    public enum Kind {
        ADDED,
        CHANGED,
        UNCHANGED,
        ENDED
    }

    /**
     * Returns the change for each version, in order; then the end of each replaced field that is not among them.
     *
     * @param known every version of {@code service.fields}
     * @param replaced the fields that the versions replace
     * @param validFrom end of the fields that are not among them, epoch ms
     */
    public static List<FieldChange> of(
            List<FieldVersion> versions, List<FieldVersion> known, Predicate<FieldVersion> replaced, long validFrom) {
        List<FieldChange> changes = new ArrayList<>();
        for (FieldVersion version : versions) {
            FieldVersion before = asOf(version.validFrom(), known).get(version.id());
            changes.add(new FieldChange(kind(version, before), version, before));
        }
        Set<String> held = versions.stream().map(FieldVersion::id).collect(Collectors.toSet());
        asOf(validFrom, known).values().stream()
                .filter(field -> replaced.test(field) && !held.contains(field.id()))
                .forEach(field -> changes.add(new FieldChange(Kind.ENDED, end(field.id(), validFrom), field)));
        return changes;
    }

    /** Returns the versions of changes that are to be written. */
    public static List<FieldVersion> toWrite(List<FieldChange> changes) {
        return changes.stream()
                .filter(change -> change.kind() != Kind.UNCHANGED)
                .map(FieldChange::version)
                .toList();
    }

    /**
     * Returns {@code id}, {@code name}, {@code domain} and {@code change}, in lower case; {@code domainBefore} where it was another.
     * Name and domain of an ended field are those that it had; missing ones are empty.
     */
    public ObjectNode toJson() {
        FieldVersion shown = kind == Kind.ENDED ? before : version;
        ObjectNode json = NgsiJson.object()
                .put("id", shown.id())
                .put("name", shown.name())
                .put("domain", shown.domain())
                .put("change", kind.name().toLowerCase(Locale.ROOT));
        return before == null || before.domain().equals(shown.domain())
                ? json
                : json.put("domainBefore", before.domain());
    }

    /** The version that ends a field. */
    static FieldVersion end(String id, long time) {
        return new FieldVersion(id, time, null, NgsiJson.object());
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

    private static Kind kind(FieldVersion version, FieldVersion before) {
        if (before == null) {
            return Kind.ADDED;
        }
        return isSame(before, version) ? Kind.UNCHANGED : Kind.CHANGED;
    }

    /** Compares versions as read back from JSON, so that 1 and 1.0 are normalized as on the topic. */
    private static boolean isSame(FieldVersion one, FieldVersion other) {
        FieldVersion before = readBack(one);
        FieldVersion now = readBack(other);
        return before.geometry().equals(now.geometry()) && before.properties().equals(now.properties());
    }

    private static FieldVersion readBack(FieldVersion version) {
        return NgsiJson.own(() -> FieldVersion.read(version.toBytes()));
    }
}
