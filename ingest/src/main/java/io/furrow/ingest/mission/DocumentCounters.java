package io.furrow.ingest.mission;

import java.util.HashMap;
import java.util.Map;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;

import io.furrow.flink.PerMission;
import io.furrow.model.topic.TopicName;

/**
 * Counts what MongoDB has acknowledged: {@code documents}, and the same in a group per {@code mission}; the first so many
 * missions of a subtask have their own, all others share {@code others}.
 */
final class DocumentCounters {
    private final MetricGroup group;
    private final Counter all;
    private final Map<String, Counter> perCollection = new HashMap<>();
    private Counter others;

    DocumentCounters(MetricGroup group) {
        this.group = group;
        this.all = group.counter("documents");
    }

    void add(MissionDocument document, long number) {
        all.inc(number);
        of(document.collection()).inc(number);
    }

    private Counter of(String collection) {
        Counter known = perCollection.get(collection);
        if (known != null) {
            return known;
        }
        if (perCollection.size() < PerMission.USUAL_LIMIT) {
            String part = collection.substring(MissionCollections.PREFIX.length());
            Counter made = counter(TopicName.original(part).orElse(part));
            perCollection.put(collection, made);
            return made;
        }
        if (others == null) {
            others = counter("others");
        }
        return others;
    }

    private Counter counter(String mission) {
        return group.addGroup("mission", mission).counter("documents");
    }
}
