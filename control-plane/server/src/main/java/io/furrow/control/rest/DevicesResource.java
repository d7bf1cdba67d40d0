package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.RejectedExecutionException;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.node.TextNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.BeanParam;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.audit.AuditEntry;
import io.furrow.control.device.CredentialCsv;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.device.DeviceCredentials;
import io.furrow.control.device.RejectedCommandException;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.DeviceHistory;
import io.furrow.control.rest.view.DeviceName;
import io.furrow.control.rest.view.DeviceView;
import io.furrow.control.rest.view.HistoryQuery;
import io.furrow.control.rest.view.ResourceKind;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Role;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/** {@code /api/devices}: desired state, status, health and history of devices, and commands to them. */
@Path("/api/devices")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class DevicesResource {
    /** Lower quality than JSON, which is the default if the client accepts anything. */
    static final String CSV = CredentialCsv.TYPE + ";qs=0.5";

    private static final String DEVICE = "device";
    private static final JsonNode NO_VALUE = TextNode.valueOf("");
    private static final String GENERATION = "generation";
    private static final int MAX_AUDITED_LENGTH = 200;
    private static final Pattern COMMAND = Pattern.compile("[A-Za-z][A-Za-z0-9_-]{0,63}");

    private final StateView view;
    private final DeviceView devices;
    private final CommandClient managers;
    private final Dependencies dependencies;

    /**
     * Access to devices.
     *
     * @param commands null if commands are not supported
     * @param credentials null if credentials are not available
     * @param history null if there is no MongoDB
     */
    record Dependencies(
            FiwareScope scope, DeviceCommands commands, DeviceCredentials credentials, DeviceHistory history) {}

    DevicesResource(StateView view, CommandClient managers, Dependencies dependencies) {
        this.view = view;
        this.devices = new DeviceView(view);
        this.managers = managers;
        this.dependencies = dependencies;
    }

    /** @param mission null for all @param domain null for all */
    @GET
    public Response list(@QueryParam("mission") String mission, @QueryParam("domain") String domain) {
        return JsonResponses.ok(ResourceKind.devices(view)
                .all()
                .filter(each -> is(each, "mission", mission) && is(each, "domain", domain)));
    }

    private static boolean is(ObjectNode device, String member, String desired) {
        return desired == null || desired.equals(device.path(member).textValue());
    }

    @GET
    @Path("{device}")
    public Response get(@BeanParam DeviceName name) {
        String key = keyOf(name);
        return JsonResponses.ok(devices.withConnection(key, withSettings(key, devices.withStatus(key, find(name)))));
    }

    /** Returns the values of an attribute, thinned; of a device that is not known, or does not have it, none. */
    @GET
    @Path("{device}/history")
    public Response history(@BeanParam DeviceName name, @BeanParam HistoryQuery query) {
        if (dependencies.history() == null) {
            throw ProblemException.noMongo();
        }
        return JsonResponses.ok(dependencies.history().read(query.of(name, FiwareScope.ofIdentity(keyOf(name)))));
    }

    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    public Response credentials(@Context ContainerRequestContext request, @BeanParam DeviceName name) {
        DesiredDevice device = withCredentials(request, name);
        return secret(dependencies.credentials().of(device));
    }

    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    @Produces(CSV)
    public Response credentialsAsCsv(@Context ContainerRequestContext request, @BeanParam DeviceName name) {
        DesiredDevice device = withCredentials(request, name);
        return csv(List.of(dependencies.credentials().of(device)));
    }

    /** Returns the credentials as a QR code, for devices with a camera. */
    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials/qr")
    @Produces("image/svg+xml")
    public Response qr(@Context ContainerRequestContext request, @BeanParam DeviceName name) {
        DesiredDevice device = withCredentials(request, name);
        return Response.ok(dependencies.credentials().qr(device))
                .header("Cache-Control", "no-store")
                .build();
    }

    /** Gives the device a new password and revokes the old one. */
    @POST
    @RolesAllowed(Role.ADMINS)
    @Path("{device}/credentials")
    public CompletionStage<Response> rotate(@Context ContainerRequestContext request, @BeanParam DeviceName name) {
        DesiredDevice device = provisioned(name);
        return new Manager(managers, Topics.MISSION_MANAGER)
                .request(request, "rotate-credentials", about(name))
                .thenApply(answer -> answer.error().isPresent()
                        ? JsonResponses.of(answer)
                        : secret(dependencies
                                .credentials()
                                .of(device.withGeneration(
                                        answer.json().path(GENERATION).asInt()))));
    }

    static Response secret(JsonNode credentials) {
        return JsonResponses.json(200, credentials)
                .header("Cache-Control", "no-store")
                .build();
    }

    static Response csv(Iterable<? extends JsonNode> credentials) {
        return Response.ok(CredentialCsv.of(credentials), CredentialCsv.TYPE + ";charset=utf-8")
                .header("Cache-Control", "no-store")
                .build();
    }

    private static ObjectNode about(DeviceName name) {
        return NgsiJson.object().put(DEVICE, name.id());
    }

    /** Returns a device whose credentials this control plane can show. */
    private DesiredDevice provisioned(DeviceName name) {
        find(name);
        String key = keyOf(name);
        DesiredDevice device = devices.find(key)
                .filter(found -> DeviceCredentials.areIssuedFor(found)
                        && key.equals(dependencies.scope().identity(name.id())))
                .orElse(null);
        if (device == null) {
            throw new ProblemException(
                    ErrorCode.NO_CREDENTIALS,
                    "device '%s' has its own login, which the control plane does not know; list the device as an object with a 'type' to give it credentials"
                            .formatted(name.id()));
        }
        requireSecret(dependencies.credentials());
        return device;
    }

    /** As {@link #provisioned}, and audits the access to its credentials. */
    private DesiredDevice withCredentials(ContainerRequestContext request, DeviceName name) {
        DesiredDevice device = provisioned(name);
        audit(RequestContext.user(request), "credentials", about(name), null);
        return device;
    }

    static void requireSecret(DeviceCredentials credentials) {
        ProblemException.rejectIf(
                credentials == null,
                ErrorCode.NO_CREDENTIALS,
                "this control plane does not know the secret of the farm; start it with --farm-secret");
    }

    /** Sends a command. Answers once the context broker has accepted it, which does not mean that the device has executed it. */
    @POST
    @Path("{device}/commands")
    public CompletionStage<Response> command(
            @Context ContainerRequestContext request, @BeanParam DeviceName name, InputStream body) throws IOException {
        ObjectNode members = JsonBodyReader.read(body);
        // With a type the device need not be on a mission, so that any robot can be stopped.
        ObjectNode device = members.hasNonNull("type") ? existing(name).orElse(members) : find(name);
        String command = members.path("command").asText();
        JsonNode value = members.has("value") ? members.get("value") : NO_VALUE;
        String key = keyOf(name);
        String named = members.path("type").asText();
        String type = devices.spelledType(key, named, device.path("type").asText(named));
        check(members, command, type);
        ObjectNode about = about(name);
        FiwareScope scope = FiwareScope.ofIdentity(key);
        if (!scope.equals(dependencies.scope())) {
            about.put("service", scope.service()).put("servicePath", scope.servicePath());
        }
        if (members.has("value")) {
            about.set("value", abbreviated(value));
        }
        if (dependencies.commands() == null) {
            throw new ProblemException(
                    501, "no-context-broker", "this control plane was started without a context broker for commands");
        }
        String user = RequestContext.user(request);
        return dependencies
                .commands()
                .in(scope)
                .send(new DeviceCommands.Order(name.id(), type, command, value))
                .handle((sent, failure) -> answer(failure, new SentCommand(user, name.id(), command, about)));
    }

    private record SentCommand(String user, String device, String command, ObjectNode about) {}

    private Response answer(Throwable failure, SentCommand sentCommand) {
        if (failure == null) {
            audit(sentCommand.user(), sentCommand.command(), sentCommand.about(), null);
            ObjectNode answer = CommandResult.of("sent").json();
            return JsonResponses.json(
                            202, answer.put(DEVICE, sentCommand.device()).put("command", sentCommand.command()))
                    .build();
        }
        Throwable cause = FailureText.unwrap(failure);
        audit(sentCommand.user(), sentCommand.command(), sentCommand.about(), cause.getMessage());
        if (cause instanceof RejectedExecutionException) {
            throw ProblemException.overloaded();
        }
        int status = cause instanceof RejectedCommandException rejected ? rejected.status() : 502;
        throw new ProblemException(status, "context-broker", cause.getMessage());
    }

    /** Returns the value for the audit: long or structured values as shortened text. */
    private static JsonNode abbreviated(JsonNode value) {
        String text = value.isTextual() ? value.textValue() : value.toString();
        boolean isWhole = text.length() <= MAX_AUDITED_LENGTH && value.isValueNode() && !value.isNull();
        return isWhole ? value : TextNode.valueOf(text.substring(0, Math.min(text.length(), MAX_AUDITED_LENGTH)));
    }

    private static void check(ObjectNode members, String command, String type) {
        ProblemException.rejectIf(
                !members.has("command"), ErrorCode.MISSING_MEMBER, "the request needs a member 'command'");
        ProblemException.rejectIf(
                !members.get("command").isTextual() || !COMMAND.matcher(command).matches(),
                ErrorCode.WRONG_MEMBER,
                "'command' must be 1 to 64 of A-Z a-z 0-9 _ - that begin with a letter");
        ProblemException.rejectIf(
                members.hasNonNull("type") && !members.get("type").isTextual(),
                ErrorCode.WRONG_MEMBER,
                "'type' must be a text");
        boolean hasValue = members.hasNonNull("value") && !members.get("value").equals(NO_VALUE);
        ProblemException.rejectIf(
                hasValue && DeviceCommands.isRobot(type),
                ErrorCode.WRONG_MEMBER,
                "a robot gets commands in its attribute 'cmd', which has no room for a 'value'; leave it out");
        ProblemException.rejectIf(
                type.isEmpty(),
                ErrorCode.MISSING_MEMBER,
                "the device reports by itself: the request needs a member 'type' with the type of its entity");
    }

    private void audit(String user, String command, ObjectNode about, String failure) {
        managers.audit(AuditEntry.ofDevice(System.currentTimeMillis(), user, command, about, failure));
    }

    private ObjectNode find(DeviceName name) {
        return existing(name)
                .orElseThrow(() ->
                        new ProblemException(ErrorCode.UNKNOWN_DEVICE, "there is no device '%s'".formatted(name.id())));
    }

    private Optional<ObjectNode> existing(DeviceName name) {
        return view.find(Topics.DEVICES, keyOf(name))
                .filter(found -> name.isOfType(found.path("type").asText()));
    }

    private String keyOf(DeviceName name) {
        return name.key(view.keys(Topics.DEVICES), dependencies.scope());
    }

    /** Adds the settings of its group, which lists of devices omit because of their size. */
    private ObjectNode withSettings(String key, ObjectNode device) {
        devices.find(key)
                .filter(found -> !found.settings().isEmpty())
                .ifPresent(found -> device.set("settings", found.settings()));
        return device;
    }
}
