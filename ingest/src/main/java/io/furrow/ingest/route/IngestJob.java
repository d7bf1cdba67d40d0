package io.furrow.ingest.route;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.PassOnce;
import io.furrow.flink.TopicRecord;

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

    /** The pipeline: everything to be written, each record naming its topic. */
    static DataStream<TopicRecord> define(DataStream<TopicRecord> records, IngestOptions options) {
        SingleOutputStreamOperator<ReportedEvent> events =
                records.process(new RecognizeEvents()).uid("recognize-events").name("Recognize events");

        SingleOutputStreamOperator<ReportedEvent> once = events.keyBy(ReportedEvent::identity)
                .process(new PassOnce<>(options.repeatWindow(), ReportedEvent::id))
                .returns(ReportedEvent.class)
                .uid("pass-once")
                .name("Pass each event once");

        SingleOutputStreamOperator<TopicRecord> routed = once.flatMap(new RouteEvents(
                        options.defaultDomain().orElse(""),
                        options.defaultMission().orElse("")))
                .uid("route-events")
                .name("Route by domain and mission");

        return routed.union(events.getSideOutput(DeadLetters.TAG));
    }
}
