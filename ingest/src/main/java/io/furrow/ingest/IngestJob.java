package io.furrow.ingest;

import java.util.List;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.device.ParseDevices;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.kafka.KafkaOutput;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.DeduplicateById;
import io.furrow.flink.time.KeyedLatenessOperator;
import io.furrow.flink.time.KeyedTimelessBroadcastOperator;
import io.furrow.ingest.image.ImageStage;
import io.furrow.ingest.latest.LatestKey;
import io.furrow.ingest.route.AssignMission;
import io.furrow.ingest.route.NameBudget;
import io.furrow.ingest.route.ParseEvents;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.ingest.route.StampIngest;
import io.furrow.model.topic.Topics;

/**
 * The job {@code ingest}: deduplicates events and writes them to the {@link IngestBranch parts} of this instance:
 * routes, latest state, missions, images and catalog; unreadable records become dead letters.
 */
public final class IngestJob {
    private IngestJob() {}

    /** Returns the whole job on Kafka, ready to be executed. */
    public static StreamExecutionEnvironment assemble(IngestOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        define(
                IngestInputs.ofKafka(env, options),
                KafkaOutput.of(options, options.topics().settings(Set.of(Topics.LATEST, Topics.CATALOG))),
                options);

        return env;
    }

    /** The pipeline; records for Kafka name their topic, other branches have their own sinks. */
    static void define(IngestInputs in, KafkaOutput kafka, IngestOptions options) {
        SingleOutputStreamOperator<ReportedEvent> recognized = in.records()
                .process(new ParseEvents(
                        ClockSkewLimit.of(options),
                        options.does(IngestBranch.LATEST) && options.latestKey() == LatestKey.ID))
                .uid("recognize-events")
                .name("Recognize events");

        SingleOutputStreamOperator<DeviceChange> devices = in.devices()
                .process(new ParseDevices("ingest"))
                .setParallelism(1) // a device's versions stay in order
                .uid("recognize-devices")
                .name("Recognize devices");

        SingleOutputStreamOperator<ReportedEvent> assigned = recognized
                .keyBy(ReportedEvent::identity)
                .connect(devices.broadcast())
                .transform(
                        "Assign domain and mission",
                        TypeInformation.of(ReportedEvent.class),
                        new KeyedTimelessBroadcastOperator<>(
                                new AssignMission(
                                        in.devicesAtStart(),
                                        options.assignment(),
                                        new NameBudget(
                                                in.domains(),
                                                in.missions(),
                                                in.topics(),
                                                options.writesRoutes(),
                                                options.otherNames())),
                                List.of(AssignMission.DEVICES)))
                .uid("assign-domain-and-mission");

        SingleOutputStreamOperator<ReportedEvent> once = IngestBranches.keyed(assigned)
                .transform(
                        "Deduplicate events by id",
                        TypeInformation.of(ReportedEvent.class),
                        new KeyedLatenessOperator<>(new DeduplicateById<ReportedEvent>(
                                options.repeatWindow(),
                                ReportedEvent::id,
                                ReportedEvent::domain,
                                ReportedEvent::mission)))
                .uid("deduplicate-by-id");

        SingleOutputStreamOperator<ReportedEvent> moved = ImageStage.move(
                        IngestBranches.keyed(once), options.images(), options.storing())
                .uid("move-images")
                .name("Move images to files");

        SingleOutputStreamOperator<ReportedEvent> events =
                moved.map(new StampIngest()).uid("stamp-ingest").name("Stamp the time of ingest");

        IngestBranches branches = new IngestBranches(kafka, options);
        branches.route(events);
        branches.storeLatest(events, in.latestAtStart());
        branches.listImages(moved);
        branches.storeCatalog(events);
        branches.storeMissions(events);
        branches.setAside(IngestBranch.ROUTES, recognized, devices);
        branches.setAsideNames(assigned);
        branches.setAside(IngestBranch.IMAGES, moved);
        branches.writeDead();
    }
}
