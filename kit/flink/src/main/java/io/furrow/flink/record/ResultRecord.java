package io.furrow.flink.record;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

/**
 * Creates the record of a job's result: an entity in normalized form with the headers of every {@code data.*} record; in an epoch of a
 * replay it has the original times and names the epoch. It does not depend on the wall clock, so a job that computes the same result again
 * writes the same record with the same event id.
 */
public final class ResultRecord {
    private ResultRecord() {}

    /**
     * @param timestamp event time of the result, see {@link Epochs}; its original time is that of the record and of {@code ts-device}
     * @param source the job, for instance {@code /analytics/temperature}
     */
    public static TopicRecord of(
            String topic, String key, EntityBuilder entity, FiwareScope scope, long timestamp, String source) {
        long original = Epochs.original(timestamp);
        Instant time = Instant.ofEpochMilli(original);
        Map<String, String> headers = new LinkedHashMap<>();
        // By event time: equal results in two epochs are not duplicates.
        headers.put(HeaderNames.CE_ID, EventId.of(scope, entity, Instant.ofEpochMilli(timestamp)));
        headers.put(HeaderNames.CE_SOURCE, source);
        headers.put(HeaderNames.CE_TIME, time.toString());
        headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
        headers.put(HeaderNames.SERVICE, scope.service());
        headers.put(HeaderNames.SERVICE_PATH, scope.servicePath());
        headers.put(HeaderNames.TS_DEVICE, Long.toString(original));
        if (Topics.isOfReplay(topic)) {
            headers.put(HeaderNames.REPLAY_EPOCH, Long.toString(Epochs.of(timestamp)));
        }
        return TopicRecord.of(topic, original, key, entity.toBytes(), headers);
    }
}
