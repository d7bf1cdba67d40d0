package io.furrow.soak.control;

import java.net.URI;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * A request to a manager, which can be sent over its topic or over the REST API.
 *
 * @param id identifies the request, which has one effect and one answer
 * @param members of the request except type, command and id
 */
record ControlRequest(String id, String topic, String command, ObjectNode members) {
    /** The request for the REST API. @param body null for none */
    record Call(String method, String path, byte[] body) {}

    /** The value of the record for the topic. */
    byte[] toBytes() {
        ObjectNode json = NgsiJson.mapper().createObjectNode();
        json.put("type", "request").put("requestId", id).put("command", command);
        json.setAll(members);
        return NgsiJson.write(json);
    }

    Call toCall() {
        return switch (topic) {
            case Topics.DOMAIN_MANAGER -> domain();
            case Topics.MISSION_MANAGER -> mission();
            case Topics.REPLAY_MANAGER -> replay();
            case Topics.ALARM_MANAGER -> alarm();
            default -> throw new IllegalStateException("there is no manager of " + topic);
        };
    }

    private Call domain() {
        return switch (command) {
            case "create" -> post("/api/domains");
            case "change" -> new Call("PATCH", "/api/domains/" + name("domain"), body());
            default ->
                new Call(
                        "DELETE",
                        "/api/domains/" + name("domain") + "?force="
                                + members.path("force").asBoolean(),
                        null);
        };
    }

    private Call mission() {
        String mission = "/api/missions/" + name("mission");
        return switch (command) {
            case "create" -> post("/api/missions");
            case "add-devices" -> post(mission + "/devices");
            case "delete" -> new Call("DELETE", mission, null);
            case "rotate-credentials" -> new Call("POST", "/api/devices/" + name("device") + "/credentials", null);
            case "save-template" -> post("/api/templates");
            case "delete-template" ->
                new Call(
                        "DELETE",
                        "/api/templates/" + name("template")
                                + (members.has("version")
                                        ? "@" + members.path("version").asInt()
                                        : ""),
                        null);
            default -> post(mission + "/" + command);
        };
    }

    private Call replay() {
        return switch (command) {
            case "start" -> post("/api/replays");
            case "stop" -> new Call("DELETE", "/api/replays/" + name("replay"), null);
            default -> post("/api/replays/" + name("replay") + "/" + command);
        };
    }

    private Call alarm() {
        return members.has("alarm")
                ? post("/api/alarms/" + name("alarm") + "/" + command)
                : post("/api/alarms/" + command);
    }

    private Call post(String path) {
        return new Call("POST", path, body());
    }

    private byte[] body() {
        return NgsiJson.write(members);
    }

    private String name(String member) {
        return URI.create(members.path(member).asText()).toString();
    }
}
