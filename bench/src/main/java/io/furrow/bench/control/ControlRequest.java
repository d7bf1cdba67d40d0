package io.furrow.bench.control;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.topic.Topics;

/**
 * The n-th request of a load: alternately a change of a domain, and a step of a mission without devices, which is started, stopped
 * and deleted, so that the managers' state does not grow except for ids. At most {@value #OUTSTANDING} may be in flight, so that the
 * steps of a mission stay in order.
 *
 * @param topic of the manager
 * @param method of HTTP
 * @param path in the REST API
 * @param expected status of the answer
 */
record ControlRequest(String topic, String command, ObjectNode members, String method, String path, String expected) {
    /** Number of required domains, {@code bench-0} and so on. */
    static final int DOMAINS = 10;

    static final int OUTSTANDING = 2000;

    /** This many missions are started, then stopped, then deleted: the steps of one mission are far apart. */
    private static final int MISSIONS = 2000;

    private static final int STEPS = 3;

    /** @param run unique to the load, part of the missions' names */
    static ControlRequest of(long number, String run) {
        ObjectNode members = JsonNodeFactory.instance.objectNode();
        String domain = "bench-" + number % DOMAINS;
        if (number % 2 == 0) {
            members.put("domain", domain).put("description", "as of request " + number);
            return new ControlRequest(
                    Topics.DOMAIN_MANAGER, "change", members, "PATCH", "/api/domains/" + domain, "changed");
        }
        long turn = number / 2;
        long step = turn / MISSIONS;
        String mission = "bench-" + run + "-" + (step / STEPS * MISSIONS + turn % MISSIONS);
        members.put("mission", mission);
        String path = "/api/missions/" + mission;
        return switch ((int) (step % STEPS)) {
            case 0 ->
                new ControlRequest(
                        Topics.MISSION_MANAGER,
                        "start",
                        members.put("domain", "bench-0"),
                        "POST",
                        path + "/start",
                        "created");
            case 1 -> new ControlRequest(Topics.MISSION_MANAGER, "stop", members, "POST", path + "/stop", "deleted");
            default -> new ControlRequest(Topics.MISSION_MANAGER, "delete", members, "DELETE", path, "deleted");
        };
    }

    /** The content of the request's record. */
    ObjectNode record(String requestId) {
        return members.deepCopy()
                .put("type", "request")
                .put("requestId", requestId)
                .put("command", command);
    }
}
