package io.furrow.ingest;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamUtils;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;

import io.furrow.flink.kafka.DeadLetterSink;
import io.furrow.flink.kafka.KafkaOutput;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.DeduplicateById;
import io.furrow.flink.time.KeyedLatenessOperator;
import io.furrow.ingest.catalog.CatalogStage;
import io.furrow.ingest.image.ImageStage;
import io.furrow.ingest.latest.MergeLatest;
import io.furrow.ingest.latest.MergeLatestOperator;
import io.furrow.ingest.mission.MissionEvent;
import io.furrow.ingest.mission.MissionStage;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.ingest.route.RouteEvents;
import io.furrow.model.event.HeaderNames;

/** The branches of the job, as configured. Each branch receives every event once, with domain, mission and stamps. */
final class IngestBranches {
    private final KafkaOutput kafka;
    private final IngestOptions options;
    private final List<DataStream<TopicRecord>> dead = new ArrayList<>();

    IngestBranches(KafkaOutput kafka, IngestOptions options) {
        this.kafka = kafka;
        this.options = options;
    }

    void route(DataStream<ReportedEvent> events) {
        if (options.does(IngestBranch.ROUTES)) {
            SingleOutputStreamOperator<TopicRecord> routed = events.process(new RouteEvents(options.writesRoutes()))
                    .uid("route-events")
                    .name("Route by domain and mission");

            kafka.write("routes", routed);
        }
    }

    void storeLatest(DataStream<ReportedEvent> events, TopicSnapshot latestAtStart) {
        if (options.writesLatest()) {
            SingleOutputStreamOperator<TopicRecord> latest = keyed(events)
                    .transform(
                            "Merge the newest of each entity",
                            TypeInformation.of(TopicRecord.class),
                            new MergeLatestOperator(
                                    new MergeLatest(options.deletionMemory(), options.latestKey()),
                                    options.latestKey(),
                                    latestAtStart,
                                    options.clocks().maxAhead()))
                    .uid("merge-latest");

            kafka.write("latest", latest);
        }
    }

    void listImages(SingleOutputStreamOperator<ReportedEvent> moved) {
        if (options.does(IngestBranch.IMAGES) && options.images().areMoved()) {
            kafka.write("images", moved.getSideOutput(ImageStage.MANIFEST));
        }
    }

    void storeCatalog(DataStream<ReportedEvent> events) {
        if (options.writesCatalog()) {
            kafka.write(
                    "catalog", CatalogStage.keep(keyed(events), options.catalogInterval(), options.catalogRetention()));
        }
    }

    void storeMissions(DataStream<ReportedEvent> events) {
        if (options.does(IngestBranch.MISSIONS) && options.missions().isOn()) {
            DataStream<MissionEvent> ofMissions = events.map(
                            event -> new MissionEvent(event.domain(), event.mission(), event.record()))
                    .returns(MissionEvent.class)
                    .uid("name-missions")
                    .name("Name the mission");

            TopicOptions.Settings topics = options.topics().settings(Set.of());
            dead.add(MissionStage.keep(ofMissions, options.missions(), new DeadLetterSink(options, topics)));
        }
    }

    /** Adds the dead letters of these stages, if this instance does their part; see {@link #writeDead}. */
    void setAside(IngestBranch ingestBranch, SingleOutputStreamOperator<?>... stages) {
        if (options.does(ingestBranch)) {
            for (SingleOutputStreamOperator<?> stage : stages) {
                dead.add(stage.getSideOutput(DeadLetters.TAG));
            }
        }
    }

    /** Adds one dead letter per event of the stage before {@link DeduplicateById}, which receives each copy. */
    void setAsideNames(SingleOutputStreamOperator<ReportedEvent> assigned) {
        if (options.does(IngestBranch.ROUTES)) {
            dead.add(assigned.getSideOutput(DeadLetters.TAG)
                    .keyBy(IngestBranches::eventId)
                    .transform(
                            "Deduplicate dead letters by event id",
                            TypeInformation.of(TopicRecord.class),
                            new KeyedLatenessOperator<>(
                                    new DeduplicateById<>(options.repeatWindow(), IngestBranches::eventId)))
                    .uid("deduplicate-dead-letters"));
        }
    }

    /** With the key and scope, because a foreign producer may count its ids per entity. */
    private static String eventId(TopicRecord letter) {
        Map<String, String> headers = letter.headers();
        return Stream.of(HeaderNames.CE_ID, HeaderNames.SERVICE, HeaderNames.SERVICE_PATH)
                .map(headers::get)
                .collect(Collectors.joining("\n", "", "\n" + Arrays.toString(letter.key())));
    }

    /** Writes all dead letters added, and those of missions. */
    void writeDead() {
        dead.stream().reduce(DataStream::union).ifPresent(letters -> kafka.write("dead-letters", letters));
    }

    /** The events are partitioned by this key already, so that there is no shuffle. */
    static KeyedStream<ReportedEvent, String> keyed(DataStream<ReportedEvent> events) {
        return DataStreamUtils.reinterpretAsKeyedStream(events, ReportedEvent::identity);
    }
}
