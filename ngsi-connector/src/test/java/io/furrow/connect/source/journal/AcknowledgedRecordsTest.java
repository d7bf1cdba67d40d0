package io.furrow.connect.source.journal;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.admin.RecordsToDelete;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.clients.producer.internals.BuiltInPartitioner;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.internals.RecordHeader;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalSettings;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Retention has deleted the oldest records of a partition and of the dead letters; one acknowledged record is missing. */
@Tag("full")
class AcknowledgedRecordsTest {
    private static final String TOPIC = "data.raw";
    private static final String DEAD = "data.raw.dead";
    private static final int EVENTS = 8;
    private static final long NOW = 1_795_223_400_000L;

    /** The first event was received ten minutes before the others, as after an outage of Kafka. */
    @ParameterizedTest
    @ValueSource(ints = {0, EVENTS - 1})
    void findsTheMissingRecord(int missing, @TempDir Path directory) throws Exception {
        Path folder = Files.createDirectories(directory.resolve("journal"));
        JournalSettings settings = JournalSettings.of(64 * 1024 * 1024, 1024 * 1024, 0);
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"));
                Journal journal = Journal.open(folder, settings).orElseThrow();
                var producer =
                        new KafkaProducer<>(kafka.producerSettings(), new StringSerializer(), new StringSerializer())) {
            kafka.createTopics(List.of(new NewTopic(TOPIC, 2, (short) 1), new NewTopic(DEAD, 1, (short) 1)));
            int other = 1 - partition("d" + missing);
            for (int i = 0; i < 2; i++) {
                producer.send(new ProducerRecord<>(DEAD, 0, "k", "unreadable")).get();
                producer.send(new ProducerRecord<>(TOPIC, other, "k", "of another producer"))
                        .get();
            }
            try (Admin admin = Admin.create(kafka.client())) {
                admin.deleteRecords(Map.of(
                                new TopicPartition(DEAD, 0), RecordsToDelete.beforeOffset(1),
                                new TopicPartition(TOPIC, other), RecordsToDelete.beforeOffset(2)))
                        .all()
                        .get();
            }
            for (int i = 0; i < EVENTS; i++) {
                Map<String, String> headers = Map.of(
                        HeaderNames.CE_ID,
                        "id" + i,
                        HeaderNames.TS_SOURCE,
                        Long.toString(i == 0 ? NOW - 600_000 : NOW + i));
                var record = new KafkaRecord(TOPIC, "d" + i, new byte[] {'1'}, Instant.ofEpochMilli(NOW), headers);
                journal.append(List.of(JournalRecordCodec.write(record)))
                        .orElseThrow()
                        .get();
                if (i != missing) {
                    var sent = new ProducerRecord<>(TOPIC, record.key(), "1");
                    headers.forEach((name, value) -> sent.headers().add(new RecordHeader(name, value.getBytes(UTF_8))));
                    producer.send(sent).get();
                }
            }

            Map<String, Object> client = Map.of("bootstrap.servers", kafka.bootstrapServers());
            assertThat(new AcknowledgedRecords(client, List.of(TOPIC, DEAD)).firstMissing(journal, EVENTS))
                    .isEqualTo(missing);
        }
    }

    private static int partition(String key) {
        return BuiltInPartitioner.partitionForKey(key.getBytes(UTF_8), 2);
    }
}
