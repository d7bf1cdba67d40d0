package io.furrow.flink.record;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.flink.core.execution.JobClient;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.NewTopic;
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
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.KafkaInput;
import io.furrow.flink.time.TellEventTime;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A replay on two partitions, read by a job of two subtasks with an idle timeout of 200 ms. */
@Timeout(180)
@Tag("full")
class PausedReplayIT {
    private static final String REPLAY = "data.hoeing.replay.0a1b2c3d";
    private static final TopicPartition SEEN = new TopicPartition("seen", 0);
    /** One after the other they take many times the idle timeout. */
    private static final int CHANGES = 30;

    @Test
    void goesOnWhereItWasAndBeginsAnewAfterASeekBack(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory)) {
            Map<String, Object> settings = Map.of("bootstrap.servers", kafka.bootstrapServers());
            kafka.createTopics(List.of(topic(REPLAY, 2), topic("changes", 1), topic("seen", 1)));

            try (var producer = new KafkaProducer<>(
                            kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer());
                    var consumer =
                            new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
                consumer.assign(List.of(SEEN));
                consumer.seekToBeginning(List.of(SEEN));
                JobClient job = job(kafka.bootstrapServers());
                try {
                    producer.send(event(0, "0", 50_000)).get();
                    producer.send(event(1, "0", 40_000)).get();
                    awaitEventTime(37_999, producer, consumer);
                    for (int change = 0; change < CHANGES; change++) {
                        assertThat(eventTime(producer, consumer)).isEqualTo(37_999);
                    }

                    producer.send(event(0, "1", 20_000)).get();
                    producer.send(event(1, "1", 10_000)).get();
                    awaitEventTime(Epochs.SPAN + 7_999, producer, consumer);
                } finally {
                    job.cancel().get();
                }
            }
        }
    }

    private static void awaitEventTime(
            long expected, KafkaProducer<byte[], byte[]> producer, KafkaConsumer<byte[], byte[]> consumer) {
        await().pollInSameThread().until(() -> eventTime(producer, consumer) == expected);
    }

    /** What the job says to one more change. */
    private static long eventTime(KafkaProducer<byte[], byte[]> producer, KafkaConsumer<byte[], byte[]> consumer)
            throws Exception {
        producer.send(new ProducerRecord<>("changes", 0, null, new byte[0])).get();
        List<Long> seen = new ArrayList<>();
        await().pollInSameThread().until(() -> {
            consumer.poll(Duration.ofMillis(100))
                    .forEach(each -> seen.add(Long.parseLong(new String(each.value(), UTF_8))));
            return !seen.isEmpty();
        });
        return seen.get(0);
    }

    private static NewTopic topic(String name, int partitions) {
        return new NewTopic(name, Optional.of(partitions), Optional.empty());
    }

    private static ProducerRecord<byte[], byte[]> event(int partition, String epoch, long time) {
        ProducerRecord<byte[], byte[]> event = new ProducerRecord<>(REPLAY, partition, time, null, new byte[0]);
        event.headers().add(HeaderNames.REPLAY_EPOCH, epoch.getBytes(UTF_8));
        return event;
    }

    private static JobClient job(String servers) throws Exception {
        List<JobOptions> parsed = new ArrayList<>();
        TestJob.run(
                parsed::add,
                ("copy --bootstrap-servers " + servers + " --parallelism 2 --idle-timeout 200ms --input " + REPLAY)
                        .split(" "));
        JobOptions options = parsed.get(0);
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        KafkaInput.reportedChanges(env, options, Optional.empty())
                .connect(env.fromSource(
                                KafkaConnectors.wholeTopic(options, "changes"), KafkaConnectors.alwaysIdle(), "Changes")
                        .uid("changes"))
                .process(new TellEventTime())
                .setParallelism(1)
                .uid("tell-event-time")
                .sinkTo(KafkaConnectors.sink(options))
                .uid("write-event-time");
        return env.executeAsync();
    }
}
