package io.furrow.ingest.mission;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import com.mongodb.client.MongoClient;
import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.groups.UnregisteredMetricsGroup;
import org.apache.flink.util.IOUtils;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

/**
 * Writes documents to MongoDB; idempotent across restarts, because a document's {@code _id} is its event's id. Documents that
 * the server refuses go to another sink as dead letters.
 */
public final class MissionSink implements Sink<MissionDocument> {
    private static final long serialVersionUID = 1L;

    private final MongoAccess access;
    private final Retention retention;
    private final Sink<TopicRecord> deadLetters;

    /** @param deadLetters a sink with an independent writer: it takes no part in transactions here */
    public MissionSink(MissionOptions options, Sink<TopicRecord> deadLetters) {
        this(options.access(), options.retention(), deadLetters);
    }

    MissionSink(MongoAccess access, Retention retention, Sink<TopicRecord> deadLetters) {
        this.access = access;
        this.retention = retention;
        this.deadLetters = deadLetters;
    }

    /** A writer outside of a job, for measurements: without retention. */
    public static SinkWriter<MissionDocument> writer(String uri, SinkWriter<TopicRecord> deadLetters) {
        MongoAccess access = new MongoAccess(uri, MongoAccess.Waits.of(Duration.ofMinutes(1)));
        MongoClient client = access.open();
        MissionCollections collections = new MissionCollections(client, Retention.FOR_EVER, Clock.systemUTC());
        return new MissionWriter(
                new BulkSender<>(collections, access.waits(), ignored -> {}),
                deadLetters,
                client,
                UnregisteredMetricsGroup.createSinkWriterMetricGroup());
    }

    @Override
    public SinkWriter<MissionDocument> createWriter(WriterInitContext context) throws IOException {
        SinkWriter<TopicRecord> dead = deadLetters.createWriter(context);
        List<AutoCloseable> opened = new ArrayList<>();
        try {
            MongoClient client = access.open();
            opened.add(client);
            Counter retried = context.metricGroup().counter("retried");
            MissionCollections collections = new MissionCollections(client, retention, Clock.systemUTC());
            if (context.getTaskInfo().getIndexOfThisSubtask() == 0) {
                opened.add(ExpiredDocumentsPurger.start(access, retention));
            }
            return new MissionWriter(
                    new BulkSender<>(collections, access.waits(), retried::inc),
                    dead,
                    () -> IOUtils.closeAll(opened),
                    context.metricGroup());
        } catch (RuntimeException e) {
            opened.add(dead);
            IOUtils.closeAllQuietly(opened);
            throw e;
        }
    }
}
