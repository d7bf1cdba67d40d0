package io.furrow.flink.kafka;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.Set;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.CommittedReader;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A broker compacts all segments of a topic but the active one. */
@Tag("full")
class CompactedTopicIT {
    private static final String STATE = "data.latest";
    private static final int DEVICES = 10;
    private static final long DAY_MILLIS = 24 * 3_600_000;
    private static final long INTERVAL_MILLIS = 10_000;

    @TempDir
    private Path directory;

    @Test
    void readsMinutesOfADayOfReports() throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory)) {
            kafka.createTopics(List.of(new TopicOptions.Settings(1, (short) 1, null, Set.of(STATE)).topic(STATE)));
            Properties client = kafka.client();
            try (KafkaProducer<String, String> producer =
                    new KafkaProducer<>(client, new StringSerializer(), new StringSerializer())) {
                long end = System.currentTimeMillis();
                for (long time = end - DAY_MILLIS; time < end; time += INTERVAL_MILLIS) {
                    String device = "device-" + time / INTERVAL_MILLIS % DEVICES;
                    producer.send(new ProducerRecord<>(STATE, null, time, device, "reported at " + time));
                }
            }

            // the active segment, and at most as much that the broker does not clean yet
            long most = 2 * Duration.ofMinutes(5).toMillis() / INTERVAL_MILLIS + DEVICES;
            await().atMost(Duration.ofSeconds(90)).until(() -> records(client) <= most);
            assertThat(records(client)).isGreaterThanOrEqualTo(DEVICES);
        }
    }

    private static long records(Properties client) throws Exception {
        long[] records = {0};
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(client, STATE)) {
            reader.readToEnd(record -> records[0]++);
        }
        return records[0];
    }
}
