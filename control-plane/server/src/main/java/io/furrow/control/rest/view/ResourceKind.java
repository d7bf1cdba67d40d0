package io.furrow.control.rest.view;

import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.function.UnaryOperator;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * A kind of resource whose changes clients can follow.
 *
 * @param topics with its state, each with the same keys; the first has a record for each resource
 * @param resource the state of the resource of a record of the first topic, as its list has it
 * @param identity the members that name the resource of a key
 */
public record ResourceKind(
        StateView view,
        List<String> topics,
        Function<StateView.Entry, ObjectNode> resource,
        Function<String, ObjectNode> identity) {

    public static ResourceKind missions(StateView view) {
        return new ResourceKind(
                view,
                List.of(Topics.MISSIONS, Topics.MISSIONS_STATUS),
                mission -> {
                    view.find(Topics.MISSIONS_STATUS, mission.key())
                            .ifPresent(status -> mission.value().set("status", status));
                    return mission.value().without(List.of("devices", "parts"));
                },
                key -> NgsiJson.object().put("mission", key));
    }

    public static ResourceKind devices(StateView view) {
        DeviceView devices = new DeviceView(view);
        return new ResourceKind(
                view,
                List.of(Topics.DEVICES, Topics.DEVICES_STATUS, Topics.DEVICES_HEALTH),
                device -> devices.withStatus(device.key(), device.value()),
                ResourceKind::device);
    }

    private static ObjectNode device(String key) {
        FiwareScope scope = FiwareScope.ofIdentity(key);
        return NgsiJson.object()
                .put("device", key.split("\\|", 3)[2])
                .put("service", scope.service())
                .put("servicePath", scope.servicePath());
    }

    public static ResourceKind alarms(StateView view) {
        return new ResourceKind(
                view,
                List.of(Topics.ALARMS),
                StateView.Entry::value,
                key -> NgsiJson.object().put("alarm", key));
    }

    /** Those that are over have the last status reported by their player. */
    public static ResourceKind replays(StateView view) {
        ReplayStatusView replays = new ReplayStatusView(view);
        return new ResourceKind(
                view,
                List.of(Topics.REPLAYS, Topics.REPLAYS_STATUS),
                replay -> replays.withStatus(replay.value()),
                key -> replays.withStatus(NgsiJson.object().put(ReplayStatusView.REPLAY, key)));
    }

    /** Returns the kind with changed resources. @param change may change what it is given */
    public ResourceKind mapped(UnaryOperator<ObjectNode> change) {
        return new ResourceKind(view, topics, resource.andThen(change), identity.andThen(change));
    }

    /** Returns all resources in the order of their keys. @throws ProblemException if the topics were not read yet */
    public Stream<ObjectNode> all() {
        return view.entries(topics.get(0)).map(resource);
    }

    Stream<String> keys() {
        return view.keys(topics.get(0));
    }

    Optional<ObjectNode> find(String key) {
        return view.find(topics.get(0), key).map(value -> resource.apply(new StateView.Entry(key, value)));
    }
}
