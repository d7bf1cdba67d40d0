package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.concurrent.CompletionException;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.RejectedExecutionException;
import java.util.function.Supplier;
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
import io.furrow.control.rest.access.Caller;
import io.furrow.control.rest.access.Role;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.ServiceView;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.mission.DeviceGroup;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.event.FiwareScope;
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
    private final CommandClient managers;
    private final Means means;

    /**
     * What devices are reached by.
     *
     * @param commands null if none go to devices
     * @param secret null if no credentials are given out
     */
    record Means(FiwareScope scope, DeviceCommands commands, Supplier<FarmSecret> secret) {}

    DevicesResource(ServiceView view, CommandClient managers, Means means) {
        this.view = view;
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
        return JsonResponses.ok(withSettings(described(means.scope().identity(id), find(id))));
    }

    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    public Response credentials(@Context ContainerRequestContext request, @PathParam(DEVICE) String id) {
        ObjectNode device = provisioned(id);
        audit(
                Caller.user(request),
                "credentials",
                JsonNodeFactory.instance.objectNode().put(DEVICE, id),
                null);
        return credentials(device, device.path(GENERATION).asInt());
    }

    /** Gives the device a new password, and refuses the old one from then on. */
    @POST
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    public CompletionStage<Response> rotate(@Context ContainerRequestContext request, @PathParam(DEVICE) String id) {
        ObjectNode device = provisioned(id);
        ObjectNode members = JsonNodeFactory.instance.objectNode().put(DEVICE, id);
        return managers.ask(
                        new CommandClient.CommandRequest(Topics.MISSION_MANAGER, "rotate-credentials", members),
                        Caller.of(request))
                .thenApply(answer -> answer.error().isPresent()
                        ? JsonResponses.of(answer, 0)
                        : credentials(device, answer.json().path(GENERATION).asInt()));
    }

    private Response credentials(ObjectNode device, int generation) {
        String mission = device.path("mission").asText();
        FarmSecret secret = means.secret().get();
        FarmSecret.Login login = secret.device(mission, device.path(DEVICE).textValue(), generation);
        return JsonResponses.json(
                        200,
                        JsonNodeFactory.instance
                                .objectNode()
                                .put("apiKey", secret.apiKey(mission))
                                .put("user", login.user())
                                .put("password", login.password())
                                .put("key", secret.newestKey())
                                .put(GENERATION, generation))
                .header("Cache-Control", "no-store")
                .build();
    }

    /** A device that has credentials, which can be shown here. */
    private ObjectNode provisioned(String id) {
        ObjectNode device = find(id);
        if (device.path(DEVICE).textValue() == null) {
            throw new ProblemException(
                    ErrorCode.NO_CREDENTIALS,
                    "device '%s' reports by itself, with credentials of its own".formatted(id));
        }
        if (means.secret() == null) {
            throw new ProblemException(
                    ErrorCode.NO_CREDENTIALS, "this control plane does not know the secret of the farm");
        }
        return device;
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
        ObjectNode about = JsonNodeFactory.instance.objectNode().put(DEVICE, id);
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

    /** The device with the settings of its group, which may be large: lists of devices leave them out. */
    private ObjectNode withSettings(ObjectNode device) {
        JsonNode group = device.path("group");
        String key = MissionDeviceList.key(
                device.path("mission").asText(), group.path("part").asInt());
        view.find(Topics.MISSION_DEVICES, key)
                .filter(list -> list.path("sequence").equals(group.path("sequence")))
                .map(list -> list.path("devices").path(group.path("index").asInt()))
                .filter(ObjectNode.class::isInstance)
                .ifPresent(found -> device.set("settings", DeviceGroup.settings((ObjectNode) found)));
        return device;
    }
}
