package io.furrow.analytics;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.analytics.presence.PresenceJob;
import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.analytics.temperature.TemperatureJob;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** All three jobs on a broker that makes no topic by itself, where others take less than the input does. */
@Timeout(180)
@Tag("full")
class LargeRecordsIT {
    private static final String INPUT = "reports";
    private static final String KAFKA_DEFAULT = "1048588";
    private static final int IMAGE = 2 * 1024 * 1024;
    /** Not long ago: the broker's retention goes by the record timestamp. */
    private static final long TIME = System.currentTimeMillis() / 60_000 * 60_000 - 3_600_000;

    @Test
    void goThroughTheJobsAndAreLateOrDeadByReference(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory, 0, Map.of("auto.create.topics.enable", "false"));
                EmbeddedFlink flink = EmbeddedFlink.start(3, 0)) {
            makeTopics(kafka);
            submit(kafka, flink);
            write(kafka, List.of(reported("r1", 0, 0), reported("r2", 0, 0), reported("r1", 200_000, 0)));
            for (String results : List.of(Topics.TEMPERATURE, Topics.COLLISION, Topics.PRESENCE)) {
                awaitRecords(kafka, results, 1); // made by the job; and event time has passed the first minute
            }

            byte[] broken = new byte[IMAGE];
            write(
                    kafka,
                    List.of(
                            reported("r3", 1_000, IMAGE),
                            new ProducerRecord<>(INPUT, null, TIME, utf8("broken"), broken)));

            ConsumerRecord<byte[], byte[]> late =
                    awaitRecords(kafka, Topics.TEMPERATURE_LATE, 1).get(0);
            assertThat(headers(late))
                    .containsAllEntriesOf(Map.of(OriginalReference.POSITION, "reports-0@3", "late-field", "north"))
                    .hasEntrySatisfying(
                            OriginalReference.BYTES,
                            bytes -> assertThat(Long.parseLong(bytes)).isGreaterThan(IMAGE));
            assertThat(late.timestamp()).isEqualTo(TIME + 1_000);
            assertThat(late.key()).isEqualTo(utf8("r3"));
            assertThat(Entity.parse(late.value()).number("Temperature")).contains(18.0);
            assertThat(Entity.parse(late.value()).text("Image")).isEmpty();

            assertThat(awaitRecords(kafka, Topics.dead(INPUT), 3))
                    .allSatisfy(letter -> {
                        assertThat(letter.value()).isEqualTo(new byte[4096]);
                        assertThat(headers(letter))
                                .containsEntry(DeadLetter.REASON, "not-json")
                                .containsEntry(DeadLetter.SOURCE, "reports-0@4")
                                .containsEntry(OriginalReference.POSITION, "reports-0@4")
                                .containsEntry(OriginalReference.BYTES, Integer.toString(IMAGE));
                    })
                    .extracting(letter -> headers(letter).get(DeadLetter.STAGE))
                    .containsExactlyInAnyOrder("temperature", "collision", "presence");
            assertThat(awaitRecords(kafka, Topics.COLLISION_LATE, 1)).hasSize(1);
            assertThat(awaitRecords(kafka, Topics.PRESENCE_LATE, 1)).hasSize(1);

            write(kafka, List.of(reported("r1", 400_000, 0), reported("r1", 600_000, 0)));
            assertThat(awaitRecords(kafka, Topics.TEMPERATURE, 3))
                    .as("the job went on, and was not restarted: windows at 0 s, 180 s and 360 s, each once")
                    .hasSize(3);
        }
    }

    private static void makeTopics(EmbeddedKafka kafka) throws Exception {
        NewTopic input = new NewTopic(INPUT, Optional.of(1), Optional.empty());
        Stream<NewTopic> small = Stream.of(Topics.dead(INPUT), Topics.TEMPERATURE_LATE)
                .map(name -> new NewTopic(name, Optional.of(1), Optional.empty())
                        .configs(Map.of("max.message.bytes", KAFKA_DEFAULT)));
        kafka.createTopics(Stream.concat(Stream.of(input), small).toList());
    }

    private static void submit(EmbeddedKafka kafka, EmbeddedFlink flink) {
        String fields = "src/test/resources/field/fields.geojson";
        TemperatureOptions temperature = parsed(new TemperatureOptions(), kafka, "--fields", fields);
        CollisionOptions collision = parsed(new CollisionOptions(), kafka);
        PresenceOptions presence = parsed(new PresenceOptions(), kafka, "--fields", fields);
        flink.submit(TemperatureJob.assemble(temperature).getStreamGraph());
        flink.submit(CollisionJob.assemble(collision).getStreamGraph());
        flink.submit(PresenceJob.assemble(presence).getStreamGraph());
    }

    private static <T extends JobOptions> T parsed(T options, EmbeddedKafka kafka, String... more) {
        List<String> all = new ArrayList<>(List.of("--bootstrap-servers", kafka.bootstrapServers(), "--input", INPUT));
        all.addAll(List.of("--idle-timeout", "1h", "--parallelism", "1"));
        all.addAll(List.of(more));
        JobCommandLine.of(options).parseArgs(all.toArray(String[]::new));
        return options;
    }

    private static ProducerRecord<byte[], byte[]> reported(String id, long after, int image) {
        EntityBuilder entity = Entity.builder(id, "Robot")
                .number("Latitude", 52)
                .number("Longitude", 12)
                .number("Temperature", 18)
                .text("Image", "i".repeat(image));
        var record = new ProducerRecord<>(INPUT, null, TIME + after, utf8(id), entity.toBytes());
        record.headers().add(HeaderNames.CE_ID, utf8(id + after));
        return record;
    }

    private static void write(EmbeddedKafka kafka, List<ProducerRecord<byte[], byte[]>> records) {
        Map<String, Object> settings = new HashMap<>(kafka.producerSettings());
        settings.put("max.request.size", 2 * IMAGE);
        try (var producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer())) {
            records.forEach(producer::send);
        }
    }

    /** All records of a topic, as soon as it is there with so many. */
    private static List<ConsumerRecord<byte[], byte[]>> awaitRecords(EmbeddedKafka kafka, String topic, int atLeast) {
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(kafka.client(), topic)) {
            await().alias(topic).until(() -> {
                if (reader.assign(List.of(topic))) {
                    reader.poll(Duration.ofMillis(100)).forEach(records::add);
                }
                return records.size() >= atLeast;
            });
        }
        return records;
    }

    private static Map<String, String> headers(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new java.util.TreeMap<>();
        for (Header header : record.headers()) {
            headers.put(header.key(), new String(header.value(), UTF_8));
        }
        return headers;
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }
}
