package io.furrow.ingest.catalog;

import java.time.Duration;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.KeyedStream;

import io.furrow.flink.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;

/** The branch of ingest that keeps the catalogue. */
public final class CatalogStage {
    private CatalogStage() {}

    /** @param events by identity, images moved */
    public static DataStream<TopicRecord> keep(KeyedStream<ReportedEvent, String> events, Duration interval) {
        return events.process(new ProfileEntities(interval))
                .uid("profile-entities")
                .name("Profile each entity")
                .keyBy(CatalogEntry::key)
                .process(new MergeCatalog(interval))
                .uid("merge-catalog")
                .name("Merge the catalogue");
    }
}
