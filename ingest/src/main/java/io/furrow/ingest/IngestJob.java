package io.furrow.ingest;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamUtils;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.PassOnce;
import io.furrow.flink.TopicRecord;
import io.furrow.ingest.image.ImageStage;
import io.furrow.ingest.route.ApplyDefaults;
import io.furrow.ingest.route.RecognizeEvents;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.ingest.route.RouteEvents;
import io.furrow.ingest.route.StampIngest;

/** Brings each event once to the topics of its domain and its mission; what is no event becomes a dead letter. */
public final class IngestJob {
    private IngestJob() {}

    /** The whole job on Kafka, ready to be executed. */
    public static StreamExecutionEnvironment assemble(IngestOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.source(options), KafkaEnds.watermarks(options), "Read reported events")
                .uid("read-events");

        define(records, options)
                .sinkTo(KafkaEnds.sink(options))
                .uid("write-routes")
                .name("Write to domains and missions");

        return env;
    }

    /** The pipeline: everything to be written to Kafka, each record naming its topic; other branches end in their own sinks. */
    static DataStream<TopicRecord> define(DataStream<TopicRecord> records, IngestOptions options) {
        SingleOutputStreamOperator<ReportedEvent> recognized =
                records.process(new RecognizeEvents()).uid("recognize-events").name("Recognize events");

        SingleOutputStreamOperator<ReportedEvent> once = recognized
                .keyBy(ReportedEvent::identity)
                .process(new PassOnce<>(options.repeatWindow(), ReportedEvent::id))
                .returns(ReportedEvent.class)
                .uid("pass-once")
                .name("Pass each event once");

        SingleOutputStreamOperator<ReportedEvent> assigned = once.map(new ApplyDefaults(
                        options.defaultDomain().orElse(""),
                        options.defaultMission().orElse("")))
                .uid("assign-domain-and-mission")
                .name("Assign domain and mission");

        // What follows sees an event with a reference in the place of its image. Events stay where their key put them.
        SingleOutputStreamOperator<ReportedEvent> moved = ImageStage.move(
                        DataStreamUtils.reinterpretAsKeyedStream(assigned, ReportedEvent::identity), options.images())
                .uid("move-images")
                .name("Move images to files");

        SingleOutputStreamOperator<ReportedEvent> events =
                moved.map(new StampIngest()).uid("stamp-ingest").name("Stamp the time of ingest");

        // The branches: each sees every event once, with domain, mission and stamps.
        SingleOutputStreamOperator<TopicRecord> routed =
                events.flatMap(new RouteEvents()).uid("route-events").name("Route by domain and mission");

        return routed.union(
                recognized.getSideOutput(DeadLetters.TAG),
                moved.getSideOutput(ImageStage.MANIFEST),
                moved.getSideOutput(DeadLetters.TAG));
    }
}
