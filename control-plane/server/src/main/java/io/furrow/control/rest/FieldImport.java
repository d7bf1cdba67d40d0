package io.furrow.control.rest;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.core.MultivaluedMap;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.kafka.field.FieldChange;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.FieldReader;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.field.ImportOptions;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.InvalidFileException;
import io.furrow.model.field.RejectedFeature;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.TopicName;

/**
 * An import of fields, by its query parameters: the options of {@code ./furrow fields import}.
 *
 * @param replace whether fields that are not in the file end, those of the domain or, without one, all
 * @param dryRun whether the changes are only answered
 */
record FieldImport(ImportOptions options, boolean replace, boolean dryRun) {
    private static final String DOMAIN = "domain";

    /** @throws ProblemException if a value is wrong */
    static FieldImport of(MultivaluedMap<String, String> query) {
        String domain = query.getFirst(DOMAIN);
        ProblemException.rejectIf(
                domain != null && !TopicName.isLegal(domain),
                ErrorCode.WRONG_MEMBER,
                "'domain' must be 1 to 64 of A-Z a-z 0-9 _ -");
        long validFrom = ParameterValues.time(
                "validFrom", query.getOrDefault("validFrom", List.of()), System.currentTimeMillis());
        return new FieldImport(
                new ImportOptions(
                        query.getFirst("layer"),
                        query.getFirst("crs"),
                        query.getFirst("id-property"),
                        query.getFirst("name-property"),
                        domain,
                        Instant.ofEpochMilli(validFrom)),
                Boolean.parseBoolean(query.getFirst("replace")),
                Boolean.parseBoolean(query.getFirst(CommandResult.DRY_RUN)));
    }

    /** What the audit has of it before it is carried out. */
    ObjectNode about() {
        ObjectNode about = NgsiJson.object().put("fields", 0);
        if (options.domain() != null) {
            about.put(DOMAIN, options.domain());
        }
        return replace ? about.put("replace", true) : about;
    }

    /** @throws ProblemException if the file is unusable, or features that are refused would end their fields */
    FieldFile read(byte[] bytes, FieldReader reader) throws IOException {
        Path folder = Files.createTempDirectory("furrow-fields");
        Path file = folder.resolve("fields");
        try {
            Files.write(file, bytes);
            FieldFile read = reader.read(file, options);
            if (replace && !dryRun && !read.refused().isEmpty()) {
                RejectedFeature first = read.refused().get(0);
                throw new ProblemException(
                        400,
                        "refused-features",
                        "with 'replace' nothing is written while features are refused, because their fields would end; feature %d %s"
                                .formatted(first.number(), withParameters(first.reason())));
            }
            return read;
        } catch (InvalidFileException e) {
            throw new ProblemException(
                    400, "unusable-file", withParameters(e.getMessage().replace(file.toString(), "the file")));
        } finally {
            Files.deleteIfExists(file);
            Files.deleteIfExists(folder);
        }
    }

    /** @param known every version of {@code service.fields} */
    List<FieldChange> changes(FieldFile file, List<FieldVersion> known) {
        Predicate<FieldVersion> replaced = field ->
                replace && (options.domain() == null || options.domain().equals(field.domain()));
        return FieldChange.of(
                file.fields().stream().map(ImportedField::version).toList(),
                known,
                replaced,
                options.validFrom().toEpochMilli());
    }

    /** @param changes first those of the file's fields, in order, then the ends of others */
    ObjectNode answer(FieldFile file, List<FieldChange> changes) {
        ObjectNode answer = CommandResult.of("imported").json();
        answer.put("imported", count(changes, FieldChange.Kind.ADDED) + count(changes, FieldChange.Kind.CHANGED))
                .put("unchanged", count(changes, FieldChange.Kind.UNCHANGED))
                .put("ended", count(changes, FieldChange.Kind.ENDED));
        ArrayNode fields = answer.putArray("fields");
        for (int field = 0; field < changes.size(); field++) {
            ObjectNode json = changes.get(field).toJson();
            ArrayNode mended = json.putArray("mended");
            if (field < file.fields().size()) {
                file.fields().get(field).notes().forEach(mended::add);
            }
            fields.add(json);
        }
        ArrayNode rejected = answer.putArray("refused");
        for (RejectedFeature each : file.refused()) {
            rejected.addObject()
                    .put("feature", each.number())
                    .put("id", each.id())
                    .put("reason", withParameters(each.reason()));
        }
        return dryRun ? answer.put(CommandResult.DRY_RUN, true) : answer;
    }

    private static long count(List<FieldChange> changes, FieldChange.Kind kind) {
        return changes.stream().filter(each -> each.kind() == kind).count();
    }

    /** Replaces option names in a reason of the import by parameter names. */
    private static String withParameters(String reason) {
        return reason.replaceAll("--([a-z-]+)", "'$1'");
    }
}
