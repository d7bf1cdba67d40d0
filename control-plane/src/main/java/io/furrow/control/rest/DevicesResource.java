package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.Optional;
import java.util.concurrent.CompletionException;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.RejectedExecutionException;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.audit.AuditEntry;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.device.DeviceCredentials;
import io.furrow.control.health.SilenceCause;
import io.furrow.control.rest.access.Caller;
import io.furrow.control.rest.access.Role;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.DesiredDevices;
import io.furrow.control.rest.view.ServiceView;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** {@code /api/devices}: what is requested of them, what they are, how they are, and commands to them. */
@Path("/api/devices")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class DevicesResource {
    private static final String DEVICE = "device";
    private static final String GENERATION = "generation";
    private static final int MAX_AUDITED_LENGTH = 200;
    private static final Pattern COMMAND = Pattern.compile("[A-Za-z][A-Za-z0-9_-]{0,63}");

    private final ServiceView view;
    private final DesiredDevices devices;
    private final CommandClient managers;
    private final Means means;

    /**
     * What devices are reached by.
     *
     * @param commands null if none go to devices
     * @param credentials null if none are given out
     */
    record Means(FiwareScope scope, DeviceCommands commands, DeviceCredentials credentials) {}

    DevicesResource(ServiceView view, CommandClient managers, Means means) {
        this.view = view;
        this.devices = new DesiredDevices(view);
        this.managers = managers;
        this.means = means;
    }

    /** @param mission null for all @param domain null for all */
    @GET
    public Response list(@QueryParam("mission") String mission, @QueryParam("domain") String domain) {
        return JsonResponses.ok(view.entries(Topics.DEVICES)
                .filter(each -> is(each.value(), "mission", mission) && is(each.value(), "domain", domain))
                .map(each -> described(each.key(), each.value())));
    }

    private static boolean is(ObjectNode device, String member, String wanted) {
        return wanted == null || wanted.equals(device.path(member).textValue());
    }

    /** @param id of the entity */
    @GET
    @Path("{device}")
    public Response get(@PathParam(DEVICE) String id) {
        String key = means.scope().identity(id);
        return JsonResponses.ok(withConnection(key, withSettings(described(key, find(id)))));
    }

    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    public Response credentials(@Context ContainerRequestContext request, @PathParam(DEVICE) String id) {
        WantedDevice device = provisioned(id);
        audit(Caller.user(request), "credentials", about(id), null);
        return secret(means.credentials().of(device));
    }

    /** The credentials as a QR code, for what has a camera. */
    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials/qr")
    @Produces("image/svg+xml")
    public Response qr(@Context ContainerRequestContext request, @PathParam(DEVICE) String id) {
        WantedDevice device = provisioned(id);
        audit(Caller.user(request), "credentials", about(id), null);
        return Response.ok(means.credentials().qr(device))
                .header("Cache-Control", "no-store")
                .build();
    }

    /** Gives the device a new password, and refuses the old one from then on. */
    @POST
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    public CompletionStage<Response> rotate(@Context ContainerRequestContext request, @PathParam(DEVICE) String id) {
        WantedDevice device = provisioned(id);
        return managers.ask(
                        new CommandClient.CommandRequest(Topics.MISSION_MANAGER, "rotate-credentials", about(id)),
                        Caller.of(request))
                .thenApply(answer -> answer.error().isPresent()
                        ? JsonResponses.of(answer, 0)
                        : secret(means.credentials()
                                .of(device.withGeneration(
                                        answer.json().path(GENERATION).asInt()))));
    }

    static Response secret(JsonNode credentials) {
        return JsonResponses.json(200, credentials)
                .header("Cache-Control", "no-store")
                .build();
    }

    private static ObjectNode about(String id) {
        return JsonNodeFactory.instance.objectNode().put(DEVICE, id);
    }

    /** A device that has credentials, which can be shown here. */
    private WantedDevice provisioned(String id) {
        find(id);
        WantedDevice device = devices.find(means.scope().identity(id))
                .filter(DeviceCredentials::has)
                .orElse(null);
        if (device == null) {
            throw new ProblemException(
                    ErrorCode.NO_CREDENTIALS,
                    "device '%s' has a login of its own, which is not known here; list it as an object with a 'type' to give it one"
                            .formatted(id));
        }
        requireSecret(means.credentials());
        return device;
    }

    static void requireSecret(DeviceCredentials credentials) {
        if (credentials == null) {
            throw new ProblemException(
                    ErrorCode.NO_CREDENTIALS,
                    "this control plane does not know the secret of the farm; start it with --farm-secret");
        }
    }

    /** Answers once the context broker has taken it, which does not say that the device obeyed. */
    @POST
    @Path("{device}/commands")
    public CompletionStage<Response> command(
            @Context ContainerRequestContext request, @PathParam(DEVICE) String id, InputStream body)
            throws IOException {
        ObjectNode members = Body.read(body);
        // A robot that is on no mission can be stopped too. An operator may put any entity on one.
        ObjectNode device = members.hasNonNull("type")
                ? view.find(Topics.DEVICES, means.scope().identity(id)).orElse(members)
                : find(id);
        String command = members.path("command").asText();
        String value = members.path("value").asText("");
        String type = device.path("type").asText(members.path("type").asText());
        check(members, command, type);
        ObjectNode about = about(id);
        if (!value.isEmpty()) {
            about.put("value", value.substring(0, Math.min(value.length(), MAX_AUDITED_LENGTH)));
        }
        if (means.commands() == null) {
            throw new ProblemException(
                    501, "no-context-broker", "this control plane was started without a context broker for commands");
        }
        String user = Caller.user(request);
        return means.commands()
                .send(new DeviceCommands.Order(id, type, command, value))
                .handle((sent, failure) -> answer(failure, new Commanded(user, id, command, about)));
    }

    private record Commanded(String user, String device, String command, ObjectNode about) {}

    private Response answer(Throwable failure, Commanded commanded) {
        if (failure == null) {
            audit(commanded.user(), commanded.command(), commanded.about(), null);
            ObjectNode answer = io.furrow.model.control.CommandResult.of("sent").json();
            return JsonResponses.json(
                            202, answer.put(DEVICE, commanded.device()).put("command", commanded.command()))
                    .build();
        }
        Throwable cause = failure instanceof CompletionException ? failure.getCause() : failure;
        audit(commanded.user(), commanded.command(), commanded.about(), cause.getMessage());
        throw cause instanceof RejectedExecutionException
                ? ProblemException.overloaded()
                : new ProblemException(502, "context-broker", cause.getMessage());
    }

    private static void check(ObjectNode members, String command, String type) {
        if (!members.has("command")) {
            throw new ProblemException(ErrorCode.MISSING_MEMBER, "the request needs a member 'command'");
        }
        if (!COMMAND.matcher(command).matches()) {
            throw new ProblemException(
                    ErrorCode.WRONG_MEMBER, "'command' must be 1 to 64 of A-Z a-z 0-9 _ - that begin with a letter");
        }
        if (members.path("value").isContainerNode()) {
            throw new ProblemException(ErrorCode.WRONG_MEMBER, "'value' must be a text, a number or a flag");
        }
        if (type.isEmpty()) {
            throw new ProblemException(
                    ErrorCode.MISSING_MEMBER,
                    "the device reports by itself: the request needs a member 'type' with the type of its entity");
        }
    }

    private void audit(String user, String command, ObjectNode about, String failure) {
        managers.audit(AuditEntry.ofDevice(System.currentTimeMillis(), user, command, about, failure));
    }

    private ObjectNode find(String id) {
        return view.find(Topics.DEVICES, means.scope().identity(id))
                .orElseThrow(
                        () -> new ProblemException(ErrorCode.UNKNOWN_DEVICE, "there is no device '%s'".formatted(id)));
    }

    private ObjectNode described(String key, ObjectNode wanted) {
        view.find(Topics.DEVICES_STATUS, key).ifPresent(status -> wanted.set("status", status));
        view.find(Topics.DEVICES_HEALTH, key).ifPresent(health -> {
            wanted.set("health", health);
            boolean isUp = !wanted.path("simulated").asBoolean()
                    && "running".equals(wanted.path("wanted").textValue())
                    && health.path("heard").asLong() >= wanted.path("from").asLong();
            if (isUp) { // no host says so of a real device
                wanted.putObject("status").put("state", "running").set("sequence", wanted.path("sequence"));
            }
        });
        return wanted;
    }

    /** The device with what is known of how it is connected; lists of devices leave that out. */
    private ObjectNode withConnection(String key, ObjectNode device) {
        ObjectNode connection =
                view.find(Topics.DEVICES_CONNECTION, key).orElseGet(JsonNodeFactory.instance::objectNode);
        JsonNode health = device.path("health");
        Long heard = health.hasNonNull("heard") ? health.path("heard").longValue() : null;
        if (!connection.isEmpty() && (heard == null || health.path("silent").booleanValue())) {
            cause(connection, heard).ifPresent(cause -> connection.put("cause", cause.text()));
        }
        if (heard != null) {
            long time = health.path(health.has("deviceTime") ? "deviceTime" : "lastSeen")
                    .longValue();
            connection
                    .putObject("lastReport")
                    .put("time", time)
                    .put("received", heard)
                    .put("offset", heard - time);
        }
        return connection.isEmpty() ? device : device.set("connection", connection);
    }

    private static Optional<SilenceCause> cause(ObjectNode connection, Long heard) {
        try {
            return SilenceCause.of(DeviceConnection.read(NgsiJson.write(connection)), heard);
        } catch (UnreadableException e) { // a later version wrote it, or somebody else: it is shown as it is
            return Optional.empty();
        }
    }

    /** The device with the settings of its group, which may be large: lists of devices leave them out. */
    private ObjectNode withSettings(ObjectNode device) {
        devices.find(means.scope().identity(device.path("id").asText()))
                .filter(found -> !found.settings().isEmpty())
                .ifPresent(found -> device.set("settings", found.settings()));
        return device;
    }
}
