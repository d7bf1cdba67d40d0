package io.furrow.ingest.catalog;

import java.time.Duration;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.KeyedStream;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;

/** The branch of ingest that maintains the catalog. */
public final class CatalogStage {
    private CatalogStage() {}

    /**
     * @param events by identity, images moved
     * @param interval of event time between two records of an entry
     * @param retention event time after which an entry without events is deleted
     */
    public static DataStream<TopicRecord> keep(
            KeyedStream<ReportedEvent, String> events, Duration interval, Duration retention) {
        return events.process(new ProfileEntities(interval, retention))
                .uid("profile-entities")
                .name("Profile each entity")
                .keyBy(CatalogEntry::key)
                .process(new MergeCatalog(interval, retention))
                .uid("merge-catalog")
                .name("Merge the catalog");
    }
}
