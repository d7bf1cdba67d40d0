package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
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
import io.furrow.control.device.CommandSender;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.topic.Topics;

/** {@code /api/devices}: what is wanted of them, what they are, how they are, and commands to them. */
@Path("/api/devices")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class DevicesResource {
    private static final String DEVICE = "device";
    private static final int LONGEST_AUDITED = 200;
    private static final Pattern COMMAND = Pattern.compile("[A-Za-z][A-Za-z0-9_-]{0,63}");

    private final ServiceView view;
    private final Managers managers;
    private final Means means;

    /**
     * What devices are reached by.
     *
     * @param sender null where no commands go to devices
     * @param secret null where no credentials are given out
     */
    record Means(FiwareScope scope, CommandSender sender, FarmSecret secret) {}

    DevicesResource(ServiceView view, Managers managers, Means means) {
        this.view = view;
        this.managers = managers;
        this.means = means;
    }

    /** @param mission null for all @param domain null for all */
    @GET
    public Response list(@QueryParam("mission") String mission, @QueryParam("domain") String domain) {
        return Replies.ok(view.read(Topics.DEVICES).entrySet().stream()
                .filter(each -> is(each.getValue(), "mission", mission) && is(each.getValue(), "domain", domain))
                .map(each -> described(each.getKey(), each.getValue())));
    }

    private static boolean is(ObjectNode device, String member, String wanted) {
        return wanted == null || wanted.equals(device.path(member).textValue());
    }

    /** @param id of the entity */
    @GET
    @Path("{device}")
    public Response get(@PathParam(DEVICE) String id) {
        return Replies.ok(described(means.scope().identity(id), find(id)));
    }

    @GET
    @Path("{device}/credentials")
    public Response credentials(@Context ContainerRequestContext request, @PathParam(DEVICE) String id) {
        ObjectNode device = find(id);
        String deviceId = device.path(DEVICE).textValue();
        if (means.secret() == null || deviceId == null) {
            throw new ProblemException(
                    404,
                    "no-credentials",
                    deviceId == null
                            ? "device '%s' reports by itself, with credentials of its own".formatted(id)
                            : "this control plane does not know the secret of the farm");
        }
        String mission = device.path("mission").asText();
        FarmSecret.Login login = means.secret().device(mission, deviceId);
        audit(
                Caller.user(request),
                "credentials",
                JsonNodeFactory.instance.objectNode().put(DEVICE, id),
                null);
        return Replies.json(
                        200,
                        JsonNodeFactory.instance
                                .objectNode()
                                .put("apiKey", means.secret().apiKey(mission))
                                .put("user", login.user())
                                .put("password", login.password()))
                .header("Cache-Control", "no-store")
                .build();
    }

    /** Answers once the context broker has taken it, which does not say that the device obeyed. */
    @POST
    @Path("{device}/commands")
    public Response command(@Context ContainerRequestContext request, @PathParam(DEVICE) String id, InputStream body)
            throws IOException, InterruptedException {
        ObjectNode members = Body.read(body);
        ObjectNode device = find(id);
        String command = members.path("command").asText();
        String value = members.path("value").asText("");
        String type = device.path("type").asText(members.path("type").asText());
        check(members, command, type);
        ObjectNode about = JsonNodeFactory.instance.objectNode().put(DEVICE, id);
        if (!value.isEmpty()) {
            about.put("value", value.substring(0, Math.min(value.length(), LONGEST_AUDITED)));
        }
        if (means.sender() == null) {
            throw new ProblemException(
                    501, "no-context-broker", "this control plane was started without a context broker for commands");
        }
        try {
            means.sender().send(id, type, command, value);
        } catch (IOException e) {
            audit(Caller.user(request), command, about, e.getMessage());
            throw new ProblemException(502, "context-broker", e.getMessage());
        }
        audit(Caller.user(request), command, about, null);
        ObjectNode answer = io.furrow.model.control.Response.of("sent").json();
        return Replies.json(202, answer.put(DEVICE, id).put("command", command)).build();
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
                        () -> new ProblemException(404, "unknown-device", "there is no device '%s'".formatted(id)));
    }

    private ObjectNode described(String key, ObjectNode wanted) {
        ObjectNode json = wanted.deepCopy();
        view.find(Topics.DEVICES_STATUS, key).ifPresent(status -> json.set("status", status));
        view.find(Topics.DEVICES_HEALTH, key).ifPresent(health -> json.set("health", health));
        return json;
    }
}
