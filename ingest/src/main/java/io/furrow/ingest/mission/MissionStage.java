package io.furrow.ingest.mission;

import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;

/** The branch of {@code ingest} that stores missions in MongoDB. */
public final class MissionStage {
    private MissionStage() {}

    /**
     * Returns the dead letters of events that no document can hold.
     *
     * @param refused receives those of documents that the server refuses; see {@link MissionSink}
     */
    public static DataStream<TopicRecord> keep(
            DataStream<MissionEvent> events, MissionOptions options, Sink<TopicRecord> refused) {
        SingleOutputStreamOperator<MissionDocument> documents =
                events.process(new ComposeDocuments()).uid("compose-documents").name("Compose documents");

        documents
                .sinkTo(new MissionSink(options, refused))
                .uid("write-missions")
                .name("Write missions to MongoDB");

        return documents.getSideOutput(DeadLetters.TAG);
    }
}
