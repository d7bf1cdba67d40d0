package io.furrow.kafka.field;

import java.time.Instant;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.field.FieldVersion;

/**
 * An edit of fields on {@code service.fields}, other than an import. A field ends as in an import: with a version without a geometry.
 *
 * @param written versions to write
 * @param removed keys of versions to remove, as if they had never existed
 */
public record FieldEdit(List<FieldVersion> written, List<String> removed) {
    private static final int MAX_NAMED = 20;
    private static final int MAX_QUOTE_LENGTH = 60;

    /**
     * Ends a field. Later versions are removed: otherwise the field would reappear with them.
     *
     * @param at event time, epoch ms
     * @param known every version of {@code service.fields}
     * @throws RejectedException if there is no such field, or it is not valid at that time
     */
    public static FieldEdit end(String id, long at, List<FieldVersion> known) throws RejectedException {
        List<FieldVersion> own = of(id, known);
        if (!FieldChange.asOf(at, own).containsKey(id)) {
            FieldVersion last = own.stream()
                    .filter(version -> version.validFrom() <= at)
                    .reduce((one, next) -> next)
                    .orElse(null);
            throw new RejectedException(
                    ErrorCode.WRONG_STATE,
                    last == null
                            ? "field '%s' begins at %s; end it then or later, or delete it"
                                    .formatted(
                                            id, Instant.ofEpochMilli(own.get(0).validFrom()))
                            : "field '%s' ended at %s already".formatted(id, Instant.ofEpochMilli(last.validFrom())));
        }
        return ended(own, at);
    }

    /** Ends the fields of a domain now; future ones are removed. @param now epoch ms */
    public static FieldEdit endOfDomain(String domain, long now, List<FieldVersion> known) {
        FieldEdit all = new FieldEdit(new ArrayList<>(), new ArrayList<>());
        for (String id : ofDomain(domain, now, known)) {
            FieldEdit one = ended(
                    known.stream().filter(version -> version.id().equals(id)).toList(), now);
            all.written.addAll(one.written);
            all.removed.addAll(one.removed);
        }
        return all;
    }

    /** Renames a field in all its versions: the name belongs to the field, whatever its border was. */
    public static FieldEdit rename(String id, String name, List<FieldVersion> known) throws RejectedException {
        List<FieldVersion> renamed = new ArrayList<>();
        for (FieldVersion version : of(id, known)) {
            if (!version.isEnd() && !version.name().equals(name)) {
                ObjectNode properties = version.properties().deepCopy().put("name", name);
                renamed.add(new FieldVersion(id, version.validFrom(), version.geometry(), properties));
            }
        }
        return new FieldEdit(renamed, List.of());
    }

    /** The ids of the fields that are ended or removed. */
    public List<String> ids() {
        TreeSet<String> ids = new TreeSet<>();
        written.forEach(version -> ids.add(version.id()));
        removed.forEach(key -> ids.add(key.substring(0, key.lastIndexOf('@'))));
        return List.copyOf(ids);
    }

    /** The exception for an unknown id, listing the existing ones. */
    public static RejectedException unknown(String id, List<FieldVersion> known) {
        List<String> ids = known.stream().map(FieldVersion::id).distinct().toList();
        return new RejectedException(
                ErrorCode.UNKNOWN_FIELD,
                "there is no field '%s'; there %s"
                        .formatted(
                                id.length() <= MAX_QUOTE_LENGTH ? id : id.substring(0, MAX_QUOTE_LENGTH) + "…",
                                ids.isEmpty()
                                        ? "is none"
                                        : "are: " + String.join(", ", ids.subList(0, Math.min(MAX_NAMED, ids.size())))
                                                + (ids.size() > MAX_NAMED ? ", …" : "")));
    }

    /** The ids of fields whose current version, else the next one, names the domain. */
    private static TreeSet<String> ofDomain(String domain, long now, List<FieldVersion> known) {
        TreeSet<String> ids = new TreeSet<>();
        TreeSet<String> others = new TreeSet<>(FieldChange.asOf(now, known).keySet());
        known.stream()
                .filter(version -> version.validFrom() > now && !version.isEnd() && !others.contains(version.id()))
                .filter(version -> version.domain().equals(domain))
                .forEach(version -> ids.add(version.id()));
        FieldChange.asOf(now, known).values().stream()
                .filter(version -> version.domain().equals(domain))
                .forEach(version -> ids.add(version.id()));
        return ids;
    }

    /** @param own versions of one field */
    private static FieldEdit ended(List<FieldVersion> own, long at) {
        List<FieldVersion> ends = FieldChange.asOf(at, own).keySet().stream()
                .map(id -> FieldChange.end(id, at))
                .toList();
        List<String> later = own.stream()
                .filter(version -> version.validFrom() > at)
                .map(FieldVersion::key)
                .toList();
        return new FieldEdit(ends, later);
    }

    /** In order of time. */
    private static List<FieldVersion> of(String id, List<FieldVersion> known) throws RejectedException {
        List<FieldVersion> own = known.stream()
                .filter(version -> version.id().equals(id))
                .sorted(Comparator.comparingLong(FieldVersion::validFrom))
                .toList();
        if (own.isEmpty()) {
            throw unknown(id, known);
        }
        return own;
    }
}
