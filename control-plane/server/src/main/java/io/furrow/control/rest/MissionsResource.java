package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.List;
import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.DefaultValue;
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
import io.furrow.control.device.DeviceCredentials;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.DeviceView;
import io.furrow.control.rest.view.ResourceKind;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Role;
import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/** {@code /api/missions}. */
@Path("/api/missions")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class MissionsResource {
    private static final String MISSION = "mission";
    private static final String DEVICES = "devices";

    private final StateView view;
    private final CommandClient managers;
    private final Manager manager;
    private final DeviceCredentials credentials;
    private final StateWait waits;

    /** @param credentials null if credentials are not available */
    MissionsResource(StateView view, CommandClient managers, DeviceCredentials credentials, StateWait waits) {
        this.waits = waits;
        this.view = view;
        this.managers = managers;
        this.manager = new Manager(managers, Topics.MISSION_MANAGER);
        this.credentials = credentials;
    }

    /** Lists missions without their devices. @param domain null for all */
    @GET
    public Response list(@QueryParam("domain") String domain) {
        return JsonResponses.ok(ResourceKind.missions(view)
                .all()
                .filter(mission ->
                        domain == null || domain.equals(mission.path("domain").textValue())));
    }

    @POST
    public CompletionStage<Response> create(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return manager.request(request, "create", JsonBodyReader.read(body))
                .thenApply(answer -> JsonResponses.created(request, answer, "missions", MISSION));
    }

    /**
     * Returns a mission.
     *
     * @param states for one of which to wait; none for any
     * @param timeout longest time to wait, in seconds
     */
    @GET
    @Path("{mission}")
    public CompletionStage<Response> get(
            @PathParam(MISSION) String mission,
            @QueryParam("wait") List<String> states,
            @QueryParam("timeout") @DefaultValue("30") int timeout) {
        return waits.one(() -> withStatus(find(mission)), states, timeout, this::withDevices);
    }

    private ObjectNode find(String mission) {
        return view.find(Topics.MISSIONS, mission)
                .orElseThrow(() ->
                        new ProblemException(ErrorCode.UNKNOWN_MISSION, "there is no mission '%s'".formatted(mission)));
    }

    /** Returns the credentials of all real devices of a started mission. */
    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{mission}/credentials")
    public Response credentials(@Context ContainerRequestContext request, @PathParam(MISSION) String mission) {
        return DevicesResource.secret(credentialsOf(request, mission));
    }

    @GET
    @RolesAllowed(Role.ADMINS)
    @Path("{mission}/credentials")
    @Produces(DevicesResource.CSV)
    public Response credentialsAsCsv(@Context ContainerRequestContext request, @PathParam(MISSION) String mission) {
        return DevicesResource.csv(credentialsOf(request, mission));
    }

    private ArrayNode credentialsOf(ContainerRequestContext request, String mission) {
        find(mission);
        DevicesResource.requireSecret(credentials);
        ArrayNode all = NgsiJson.array();
        new DeviceView(view)
                .of(mission).stream()
                        .filter(device -> DeviceCredentials.areIssuedFor(device) && !device.simulated())
                        .forEach(device -> all.add(credentials.of(device)));
        managers.audit(AuditEntry.ofDevice(
                System.currentTimeMillis(), RequestContext.user(request), "credentials", named(mission), null));
        return all;
    }

    /** Appends to the device list of a mission that is not active. */
    @POST
    @Path("{mission}/devices")
    public CompletionStage<Response> addDevices(
            @Context ContainerRequestContext request, @PathParam(MISSION) String mission, InputStream body)
            throws IOException {
        return manager.command(request, "add-devices", JsonBodyReader.read(body).put(MISSION, mission));
    }

    @DELETE
    @Path("{mission}")
    public CompletionStage<Response> delete(
            @Context ContainerRequestContext request, @PathParam(MISSION) String mission) {
        return manager.command(request, "delete", named(mission));
    }

    /** Starts a mission, and creates it if it does not exist. */
    @POST
    @Path("{mission}/start")
    public CompletionStage<Response> start(
            @Context ContainerRequestContext request, @PathParam(MISSION) String mission, InputStream body)
            throws IOException {
        return manager.request(request, "start", JsonBodyReader.read(body).put(MISSION, mission))
                .thenApply(answer -> JsonResponses.of(answer.after("start")));
    }

    @POST
    @Path("{mission}/stop")
    public CompletionStage<Response> stop(
            @Context ContainerRequestContext request, @PathParam(MISSION) String mission) {
        return manager.request(request, "stop", named(mission))
                .thenApply(answer -> JsonResponses.of(answer.after("stop")));
    }

    private ObjectNode withStatus(ObjectNode desired) {
        view.find(Topics.MISSIONS_STATUS, desired.path(MISSION).asText())
                .ifPresent(status -> desired.set("status", status));
        return desired;
    }

    private ObjectNode withDevices(ObjectNode mission) {
        if (!mission.has(DEVICES)) {
            ArrayNode devices = mission.putArray(DEVICES);
            for (int part = 0; part < mission.path("parts").asInt(); part++) {
                view.find(
                                Topics.MISSION_DEVICES,
                                MissionDeviceList.key(mission.path(MISSION).asText(), part))
                        .ifPresent(list -> list.path(DEVICES).forEach(devices::add));
            }
        }
        return mission.without("parts");
    }

    private static ObjectNode named(String mission) {
        return NgsiJson.object().put(MISSION, mission);
    }
}
