package io.furrow.ingest;

import java.util.Set;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamUtils;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.KafkaOutput;
import io.furrow.flink.KafkaTopicAtStart;
import io.furrow.flink.PassOnce;
import io.furrow.flink.TopicAtStart;
import io.furrow.flink.TopicRecord;
import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.device.ReadDevices;
import io.furrow.ingest.catalog.CatalogStage;
import io.furrow.ingest.image.ImageStage;
import io.furrow.ingest.latest.MergeLatest;
import io.furrow.ingest.mission.MissionEvent;
import io.furrow.ingest.mission.MissionStage;
import io.furrow.ingest.route.AssignMission;
import io.furrow.ingest.route.RecognizeEvents;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.ingest.route.RouteEvents;
import io.furrow.ingest.route.StampIngest;
import io.furrow.model.topic.Topics;

/** Brings each event once to everything that is made of events; what is no event becomes a dead letter. */
public final class IngestJob {
    /**
     * What comes in.
     *
     * @param records reported events, as on {@code data.raw}
     * @param devices the records of {@code service.devices}
     * @param devicesAtStart those that are known before the first event
     */
    record Inputs(DataStream<TopicRecord> records, DataStream<TopicRecord> devices, TopicAtStart devicesAtStart) {}

    private IngestJob() {}

    /** The whole job on Kafka, ready to be executed. */
    public static StreamExecutionEnvironment assemble(IngestOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.source(options), KafkaEnds.watermarks(options), "Read reported events")
                .uid("read-events");

        DataStream<TopicRecord> devices = env.fromSource(
                        KafkaEnds.wholeTopic(options, options.devices()), KafkaEnds.noHindrance(), "Read devices")
                .uid("read-devices")
                .setParallelism(1);

        define(
                new Inputs(records, devices, new KafkaTopicAtStart(options, options.devices())),
                KafkaOutput.of(options, options.topics().settings(Set.of(Topics.LATEST, Topics.CATALOG))),
                options);

        return env;
    }

    /** The pipeline; what goes to Kafka names its topic, other branches have sinks of their own. */
    static void define(Inputs in, KafkaOutput kafka, IngestOptions options) {
        SingleOutputStreamOperator<ReportedEvent> recognized = in.records()
                .process(new RecognizeEvents())
                .uid("recognize-events")
                .name("Recognize events");

        SingleOutputStreamOperator<DeviceChange> devices = in.devices()
                .process(new ReadDevices("ingest"))
                .setParallelism(1) // a device's versions stay in order
                .uid("recognize-devices")
                .name("Recognize devices");

        SingleOutputStreamOperator<ReportedEvent> assigned = recognized
                .keyBy(ReportedEvent::identity)
                .connect(devices.broadcast(AssignMission.DEVICES))
                .process(new AssignMission(in.devicesAtStart(), options.assignment()))
                .uid("assign-domain-and-mission")
                .name("Assign domain and mission");

        SingleOutputStreamOperator<ReportedEvent> once = keyed(assigned)
                .process(new PassOnce<>(
                        options.repeatWindow(), ReportedEvent::id, ReportedEvent::domain, ReportedEvent::mission))
                .returns(ReportedEvent.class)
                .uid("pass-once")
                .name("Pass each event once");

        SingleOutputStreamOperator<ReportedEvent> moved = moveImages(once, options);

        SingleOutputStreamOperator<ReportedEvent> events =
                moved.map(new StampIngest()).uid("stamp-ingest").name("Stamp the time of ingest");

        // The branches: each sees every event once, with domain, mission and stamps.
        route(events, kafka, options);
        keepLatest(events, kafka, options);
        listImages(moved, kafka, options);
        keepCatalog(events, kafka, options);
        DataStream<TopicRecord> dead = recognized
                .getSideOutput(DeadLetters.TAG)
                .union(devices.getSideOutput(DeadLetters.TAG), moved.getSideOutput(DeadLetters.TAG));
        kafka.write("dead-letters", options.missions().isOn() ? dead.union(keepMissions(events, options)) : dead);
    }

    /** What follows sees an event with a reference in the place of its image. */
    private static SingleOutputStreamOperator<ReportedEvent> moveImages(
            DataStream<ReportedEvent> events, IngestOptions options) {
        return ImageStage.move(keyed(events), options.images())
                .uid("move-images")
                .name("Move images to files");
    }

    private static void route(DataStream<ReportedEvent> events, KafkaOutput kafka, IngestOptions options) {
        SingleOutputStreamOperator<TopicRecord> routed = events.process(new RouteEvents(options.writesRoutes()))
                .uid("route-events")
                .name("Route by domain and mission");

        kafka.write("routes", routed);
    }

    private static void keepLatest(DataStream<ReportedEvent> events, KafkaOutput kafka, IngestOptions options) {
        if (options.writesLatest()) {
            SingleOutputStreamOperator<TopicRecord> latest = keyed(events)
                    .process(new MergeLatest(options.repeatWindow(), options.latestKey()))
                    .uid("merge-latest")
                    .name("Merge the newest of each entity");

            kafka.write("latest", latest);
        }
    }

    private static void listImages(
            SingleOutputStreamOperator<ReportedEvent> moved, KafkaOutput kafka, IngestOptions options) {
        if (options.images().areMoved()) {
            kafka.write("images", moved.getSideOutput(ImageStage.MANIFEST));
        }
    }

    /** Gives back the dead letters of what no document can hold. */
    private static DataStream<TopicRecord> keepMissions(DataStream<ReportedEvent> events, IngestOptions options) {
        DataStream<MissionEvent> ofMissions = events.map(event -> new MissionEvent(event.mission(), event.record()))
                .returns(MissionEvent.class)
                .uid("name-missions")
                .name("Name the mission");

        return MissionStage.keep(ofMissions, options.missions(), KafkaEnds.atLeastOnceSink(options));
    }

    private static void keepCatalog(DataStream<ReportedEvent> events, KafkaOutput kafka, IngestOptions options) {
        if (options.writesCatalog()) {
            kafka.write("catalog", CatalogStage.keep(keyed(events), options.catalogInterval()));
        }
    }

    /** They are at the subtask of their key already: nothing is sent again. */
    private static KeyedStream<ReportedEvent, String> keyed(DataStream<ReportedEvent> events) {
        return DataStreamUtils.reinterpretAsKeyedStream(events, ReportedEvent::identity);
    }
}
