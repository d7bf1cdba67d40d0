package io.furrow.bench.replay;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import io.furrow.model.control.DesiredReplay;

/**
 * A replay at speed 1 and its schedule.
 *
 * @param anchor when the mission's first event is due, epoch ms
 */
record ScheduledReplay(DesiredReplay replay, StoredMission mission, long anchor) {
    long due(long time) {
        return anchor + time - StoredMission.BEGIN;
    }

    /** The same at another time. */
    ScheduledReplay onto(DesiredReplay other, long later) {
        return new ScheduledReplay(other, mission, anchor + later);
    }

    /** The events on the topics of replays, in order per topic; of a repeated one the first. */
    static Map<String, List<PlayedRecord>> events(ReplayCluster cluster, List<DesiredReplay> replays) {
        Map<String, List<PlayedRecord>> events = new HashMap<>();
        replays.forEach(replay -> events.put(replay.topic(), new ArrayList<>()));
        cluster.read(events.keySet(), (topic, event) -> events.get(topic).add(event));
        events.replaceAll((topic, all) -> once(all));
        return events;
    }

    private static List<PlayedRecord> once(List<PlayedRecord> events) {
        Map<Long, PlayedRecord> bySequence = new TreeMap<>();
        events.forEach(event -> bySequence.merge(
                event.sequence(), event, (one, other) -> one.appended() <= other.appended() ? one : other));
        return List.copyOf(bySequence.values());
    }
}
