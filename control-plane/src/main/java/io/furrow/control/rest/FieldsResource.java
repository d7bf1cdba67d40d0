package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Semaphore;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.RawValue;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.audit.AuditEntry;
import io.furrow.control.rest.access.Caller;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.fields.FieldChange;
import io.furrow.fields.FieldsTopic;
import io.furrow.fields.ImportOptions;
import io.furrow.fields.ImportedField;
import io.furrow.fields.RefusedFeature;
import io.furrow.fields.file.FieldFile;
import io.furrow.fields.file.UnusableFileException;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.topic.Topics;

/** {@code /api/fields}: the fields as they are now, and those of a file, as {@code ./furrow fields import} takes them, valid from now. */
@jakarta.ws.rs.Path("/api/fields")
@Consumes({"application/geo+json", MediaType.APPLICATION_JSON, "application/geopackage+sqlite3"})
@Produces(MediaType.APPLICATION_JSON)
public final class FieldsResource {
    static final int LARGEST = 16 << 20;

    private static final Pattern DOMAIN = Pattern.compile("[A-Za-z0-9_-]{1,64}");
    private static final String FILE_NAME = "fields";
    private static final int READERS = 4;

    private final FieldsTopic topic;
    private final CommandClient managers;
    /** Files are read whole: one at a time. */
    private final Semaphore free = new Semaphore(1);
    /** Each reads the whole topic. */
    private final Semaphore readers = new Semaphore(READERS);

    FieldsResource(Properties client, CommandClient managers) {
        this.topic = new FieldsTopic(client);
        this.managers = managers;
    }

    /**
     * The fields that there are now, as a FeatureCollection; each has {@code validFrom} among its properties.
     *
     * @param domain only those that belong to it; null for all
     */
    @GET
    public Response list(@QueryParam("domain") String domain) {
        if (!readers.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        ObjectNode collection = JsonNodeFactory.instance.objectNode().put("type", "FeatureCollection");
        ArrayNode features = collection.putArray("features");
        try {
            FieldChange.asOf(System.currentTimeMillis(), topic.read()).values().stream()
                    .filter(field -> domain == null || domain.equals(field.domain()))
                    .forEach(field ->
                            features.addRawValue(new RawValue(new String(field.toBytes(), StandardCharsets.UTF_8))));
        } catch (IOException e) { // says what is unavailable, and what to do
            throw new ProblemException(503, "kafka-away", e.getMessage());
        } finally {
            readers.release();
        }
        return JsonResponses.ok(collection);
    }

    /**
     * What cannot be mended is refused by feature, the rest is written; a field that is as it was is not written again.
     *
     * @param domain of all of them; null for what each feature says
     */
    @POST
    public Response add(@Context ContainerRequestContext request, @QueryParam("domain") String domain, InputStream body)
            throws IOException {
        if (domain != null && !DOMAIN.matcher(domain).matches()) {
            throw new ProblemException(ErrorCode.WRONG_MEMBER, "'domain' must be 1 to 64 of A-Z a-z 0-9 _ -");
        }
        if (!free.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        Caller caller = Caller.of(request);
        try {
            FieldFile file = read(Body.bytes(body, LARGEST), domain);
            Changed changed = write(file);
            audit(caller, domain, changed.written(), null);
            return JsonResponses.json(200, answer(file, changed)).build();
        } catch (ProblemException problem) {
            audit(caller, domain, 0, problem);
            throw problem;
        } finally {
            free.release();
        }
    }

    private static FieldFile read(byte[] bytes, String domain) throws IOException {
        Path folder = Files.createTempDirectory("furrow-fields");
        Path file = folder.resolve(FILE_NAME);
        try {
            Files.write(file, bytes);
            return FieldFile.read(file, new ImportOptions(null, null, null, null, domain, Instant.now()));
        } catch (UnusableFileException e) {
            throw new ProblemException(400, "unusable-file", e.getMessage().replace(file.toString(), "the file"));
        } finally {
            Files.deleteIfExists(file);
            Files.deleteIfExists(folder);
        }
    }

    private record Changed(List<FieldChange> all) {
        List<FieldChange> needed() {
            return all.stream()
                    .filter(each -> each.kind() != FieldChange.Kind.UNCHANGED)
                    .toList();
        }

        int written() {
            return needed().size();
        }
    }

    private Changed write(FieldFile file) {
        try {
            Changed changed = new Changed(FieldChange.of(
                    file.fields().stream().map(ImportedField::version).toList(),
                    topic.read(),
                    false,
                    System.currentTimeMillis()));
            if (changed.written() > 0) {
                topic.write(changed.needed().stream().map(FieldChange::version).toList());
            }
            return changed;
        } catch (IOException e) { // says what is unavailable, and what to do
            throw new ProblemException(503, "kafka-away", e.getMessage());
        }
    }

    private static ObjectNode answer(FieldFile file, Changed changed) {
        ObjectNode answer = io.furrow.model.control.CommandResult.of("imported").json();
        answer.put("imported", changed.written()).put("unchanged", changed.all().size() - changed.written());
        ArrayNode fields = answer.putArray("fields");
        for (FieldChange each : changed.all()) {
            fields.addObject()
                    .put("id", each.version().id())
                    .put("name", each.version().name())
                    .put("change", each.kind().name().toLowerCase(java.util.Locale.ROOT));
        }
        ArrayNode refused = answer.putArray("refused");
        for (RefusedFeature each : file.refused()) {
            refused.addObject()
                    .put("feature", each.number())
                    .put("id", each.id())
                    .put("reason", each.reason());
        }
        return answer;
    }

    private void audit(Caller caller, String domain, int written, ProblemException problem) {
        ObjectNode about = JsonNodeFactory.instance.objectNode().put("fields", written);
        if (domain != null) {
            about.put("domain", domain);
        }
        managers.audit(new AuditEntry(
                System.currentTimeMillis(),
                caller.user(),
                Topics.FIELDS,
                "import-fields",
                about,
                problem == null ? "imported" : io.furrow.model.control.CommandResult.ERROR,
                problem == null ? null : problem.error(),
                problem == null ? null : problem.getMessage(),
                caller.requestId()));
    }
}
