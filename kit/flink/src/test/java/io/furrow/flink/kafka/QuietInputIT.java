package io.furrow.flink.kafka;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.core.execution.JobClient;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.TestJob;
import io.furrow.flink.time.TellEventTime;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(180)
@Tag("full")
class QuietInputIT {
    private static final int CHANGES = 30;

    /** Else the first event after a quiet time, and all that follow, would be late. */
    @Test
    void leavesEventTimeWhereItIsThoughTheStreamBesideItGoesOn(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory)) {
            List<Long> seen = new ArrayList<>();
            Map<String, Object> settings = Map.of("bootstrap.servers", kafka.bootstrapServers());
            try (KafkaProducer<byte[], byte[]> producer = new KafkaProducer<>(
                            kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer());
                    KafkaConsumer<byte[], byte[]> consumer =
                            new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
                for (String topic : List.of("events", "changes", "seen")) {
                    assertThat(producer.partitionsFor(topic))
                            .as("made by asking")
                            .isNotEmpty();
                }
                producer.send(record("changes")).get();
                JobClient job = job(kafka.bootstrapServers());
                try {
                    List<TopicPartition> all = consumer.partitionsFor("seen").stream()
                            .map(info -> new TopicPartition("seen", info.partition()))
                            .toList();
                    consumer.assign(all);
                    consumer.seekToBeginning(all);
                    // One after the other: by then no event has come for many times the idle timeout.
                    for (int i = 1; i <= CHANGES; i++) {
                        int expected = i;
                        await().until(() -> {
                            consumer.poll(Duration.ofMillis(100))
                                    .forEach(each -> seen.add(Long.parseLong(new String(each.value(), UTF_8))));
                            return seen.size() >= expected;
                        });
                        producer.send(record("changes")).get();
                    }
                } finally {
                    job.cancel().get();
                }
            }

            assertThat(seen).hasSizeGreaterThanOrEqualTo(CHANGES).containsOnly(Long.MIN_VALUE);
        }
    }

    private static ProducerRecord<byte[], byte[]> record(String topic) {
        return new ProducerRecord<>(topic, 0, null, "{}".getBytes(UTF_8));
    }

    private static JobClient job(String servers) throws Exception {
        List<JobOptions> parsed = new ArrayList<>();
        TestJob.run(
                parsed::add,
                "copy",
                "--bootstrap-servers",
                servers,
                "--parallelism",
                "1",
                "--input",
                "events",
                "--idle-timeout",
                "200ms");
        JobOptions options = parsed.get(0);
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.fromSource(KafkaConnectors.source(options), KafkaConnectors.watermarks(options), "Events")
                .uid("events")
                .connect(env.fromSource(
                                KafkaConnectors.wholeTopic(options, "changes"), KafkaConnectors.alwaysIdle(), "Changes")
                        .uid("changes"))
                .process(new TellEventTime())
                .uid("tell-event-time")
                .sinkTo(KafkaConnectors.sink(options))
                .uid("write-event-time");
        return env.executeAsync();
    }
}
