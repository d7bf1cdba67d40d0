package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Semaphore;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.RawValue;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.PATCH;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.kafka.field.FieldChange;
import io.furrow.kafka.field.FieldEdit;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.JsonObjectReader;
import io.furrow.model.control.RejectedException;
import io.furrow.model.control.Role;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.FieldReader;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/** {@code /api/fields}: lists fields, imports those of a file, and renames, ends or deletes a field. */
@jakarta.ws.rs.Path("/api/fields")
@Consumes({"application/geo+json", MediaType.APPLICATION_JSON, "application/geopackage+sqlite3"})
@Produces(MediaType.APPLICATION_JSON)
public final class FieldsResource {
    static final int MAX_BYTES = 16 << 20;

    private static final String FIELD = "field";
    private static final String IMPORT = "import-fields";
    private static final String NAME = "name";
    private static final String END = "validTo";
    private static final int MAX_READERS = 4;

    private final FieldsTopic topic;
    private final CommandClient managers;
    private final FieldReader reader;
    /** Permits one change at a time, because files are read into memory and changes depend on the current fields. */
    private final Semaphore changePermit = new Semaphore(1);
    /** Limits concurrent reads, because each reads the whole topic. */
    private final Semaphore readers = new Semaphore(MAX_READERS);

    FieldsResource(Properties client, CommandClient managers, FieldReader reader) {
        this.topic = new FieldsTopic(client);
        this.managers = managers;
        this.reader = reader;
    }

    /**
     * Lists fields as a FeatureCollection with {@code validFrom} among the properties.
     *
     * @param domain selects fields that belong to it; null for all
     * @param ats at most one, ISO 8601 or epoch ms: the time as of which they are listed; now by default
     * @param versions lists all versions of all times instead, those that end a field without a geometry
     */
    @GET
    public Response list(
            @QueryParam("domain") String domain,
            @QueryParam("at") List<String> ats,
            @QueryParam("versions") boolean versions) {
        long at = ParameterValues.time("at", ats, System.currentTimeMillis());
        if (!readers.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        ObjectNode collection = NgsiJson.object().put("type", "FeatureCollection");
        ArrayNode features = collection.putArray("features");
        try {
            List<FieldVersion> all = topic.read();
            (versions ? all : FieldChange.asOf(at, all).values())
                    .stream()
                            .filter(field -> domain == null || domain.equals(field.domain()))
                            .forEach(field -> features.addRawValue(
                                    new RawValue(new String(field.toBytes(), StandardCharsets.UTF_8))));
        } catch (IOException e) {
            throw unavailable(e);
        } finally {
            readers.release();
        }
        return Response.ok(collection, MediaType.APPLICATION_JSON_TYPE).build(); // see PageFilter
    }

    /**
     * Imports the fields of a file. Features that cannot be repaired are rejected one by one; unchanged fields are not
     * written again. The query parameters are those of a {@link FieldImport}.
     */
    @POST
    public Response add(@Context ContainerRequestContext request, InputStream body) throws IOException {
        FieldImport desired = FieldImport.of(request.getUriInfo().getQueryParameters());
        if (!changePermit.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        RequestContext caller = RequestContext.of(request);
        ObjectNode about = desired.about();
        try {
            FieldFile file = desired.read(JsonBodyReader.bytes(body, MAX_BYTES), reader);
            List<FieldChange> changes = desired.changes(file, topic.read());
            if (!desired.dryRun()) {
                topic.write(FieldChange.toWrite(changes));
            }
            ObjectNode answer = desired.answer(file, changes);
            about.set("fields", answer.path("imported"));
            audit(caller, IMPORT, about, desired.dryRun() ? "dry-run" : "imported", null);
            return JsonResponses.ok(answer);
        } catch (ProblemException problem) {
            audit(caller, IMPORT, about, null, problem);
            throw problem;
        } catch (IOException e) {
            ProblemException problem = unavailable(e);
            audit(caller, IMPORT, about, null, problem);
            throw problem;
        } finally {
            changePermit.release();
        }
    }

    /** Renames or ends a field: the body contains either {@code name} or {@code validTo}, a time. */
    @PATCH
    @jakarta.ws.rs.Path("{field}")
    @Consumes({JsonBodyReader.MERGE_PATCH, MediaType.APPLICATION_JSON})
    public Response change(@Context ContainerRequestContext request, @PathParam(FIELD) String id, InputStream body)
            throws IOException {
        ObjectNode members = JsonBodyReader.read(body);
        members.remove(FIELD); // that of the path, see UnknownNameFilter
        ObjectNode about = NgsiJson.object().put(FIELD, id);
        if (members.size() == 1 && members.hasNonNull(END)) {
            return edit(RequestContext.of(request), "end-field", about, () -> {
                Instant end = new JsonObjectReader(members).time(END);
                about.put(END, end.toString());
                FieldEdit edit = FieldEdit.end(id, end.toEpochMilli(), topic.read());
                topic.write(edit);
                return CommandResult.of("ended").with("removed", edit.removed().size());
            });
        }
        return edit(RequestContext.of(request), "rename-field", about, () -> {
            JsonObjectReader.refuseIf(
                    members.size() != 1 || members.path(NAME).asText("").isBlank(),
                    "body",
                    "either {\"name\": a text} or {\"validTo\": a time}");
            JsonObjectReader.checkReadable(members);
            String name = new JsonObjectReader(members).text(NAME);
            about.put(NAME, name);
            FieldEdit edit = FieldEdit.rename(id, name, topic.read());
            topic.write(edit);
            return CommandResult.of("changed").with("versions", edit.written().size());
        });
    }

    /** Deletes all versions of a field, as if it had never existed. */
    @RolesAllowed(Role.ADMINS)
    @DELETE
    @jakarta.ws.rs.Path("{field}")
    public Response delete(@Context ContainerRequestContext request, @PathParam(FIELD) String id) {
        ObjectNode about = NgsiJson.object().put(FIELD, id);
        return edit(RequestContext.of(request), "delete-field", about, () -> {
            List<String> keys = topic.keys(id);
            if (keys.isEmpty()) {
                throw FieldEdit.unknown(id, topic.read());
            }
            topic.write(new FieldEdit(List.of(), keys));
            return CommandResult.of("deleted").with("versions", keys.size());
        });
    }

    private interface Edit {
        CommandResult apply() throws RejectedException, IOException;
    }

    /** @param about members for audit and answer, to which the edit may add */
    private Response edit(RequestContext caller, String command, ObjectNode about, Edit edit) {
        if (!changePermit.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        ProblemException problem;
        try {
            CommandResult result = edit.apply();
            result.json().setAll(about);
            audit(caller, command, result.json().deepCopy().without(List.of("type", "status")), result.status(), null);
            return JsonResponses.ok(result.json());
        } catch (RejectedException e) {
            problem = new ProblemException(e.code(), e.getMessage());
        } catch (IOException e) {
            problem = unavailable(e);
        } finally {
            changePermit.release();
        }
        audit(caller, command, about, null, problem);
        throw problem;
    }

    /** Reports what is unavailable and what to do. */
    private static ProblemException unavailable(IOException cause) {
        return new ProblemException(503, "kafka-away", cause.getMessage());
    }

    /** @param problem null if there is none */
    private void audit(
            RequestContext caller, String command, ObjectNode about, String result, ProblemException problem) {
        managers.audit(caller, Topics.FIELDS, command, about, result, problem);
    }
}
