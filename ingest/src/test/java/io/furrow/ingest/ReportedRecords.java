package io.furrow.ingest;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import picocli.CommandLine;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Records of {@code data.raw}, and the job over a few of them. */
final class ReportedRecords {
    static final long TIME = 1_700_000_000_000L;

    private ReportedRecords() {}

    /** What goes to the topics of domains and missions, and to dead letters. */
    static List<TopicRecord> run(IngestOptions options, TopicRecord... records) throws Exception {
        return IngestRun.of(options, FixedDevices.of(), records).stream()
                .filter(record -> !record.topic().equals(Topics.LATEST))
                .toList();
    }

    static IngestOptions options(String... args) {
        IngestOptions options = new IngestOptions();
        CommandLine line = JobCommandLine.of(options);
        line.parseArgs(Stream.concat(Stream.of("--no-catalog"), Stream.of(args)).toArray(String[]::new));
        return options;
    }

    static EntityBuilder thermometer(String id, String domain, String mission) {
        return Entity.builder(id, "Thermometer").text("Domain", domain).text("Mission", mission);
    }

    static TopicRecord at(long time, TopicRecord record) {
        return new TopicRecord(
                record.topic(), 0, record.offset(), time, record.key(), record.value(), record.headers());
    }

    static TopicRecord deletion(String eventId, String key, long time) {
        Map<String, String> headers = Map.of(HeaderNames.CE_ID, eventId, HeaderNames.CE_TYPE, HeaderNames.TYPE_DELETED);
        return new TopicRecord("data.raw", 0, 9, time, key.getBytes(UTF_8), null, new HashMap<>(headers));
    }

    static TopicRecord record(String eventId, EntityBuilder entity) {
        Entity built = entity.build();
        return record(eventId, built.id(), new String(built.toBytes(), UTF_8));
    }

    static TopicRecord record(String eventId, String key, String value) {
        return new TopicRecord(
                "data.raw",
                0,
                7,
                TIME,
                key.getBytes(UTF_8),
                value.getBytes(UTF_8),
                new HashMap<>(Map.of(HeaderNames.CE_ID, eventId)));
    }
}
