package io.furrow.flink.kafka;

import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.TestJob;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Timeout(120)
@Tag("full")
class DeadLetterSinkIT {
    @Test
    void makesTheTopicAsTheJobMakesItsTopicsAndShortensWhatItDoesNotTake(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory);
                Admin admin = Admin.create(kafka.client())) {
            AtomicReference<JobOptions> options = new AtomicReference<>();
            TestJob.run(options::set, "copy", "--bootstrap-servers", kafka.bootstrapServers());
            Map<String, String> reasons = Map.of(DeadLetter.REASON, "refused", DeadLetter.MESSAGE, "why");
            List<TopicRecord> letters = List.of(
                    TopicRecord.of("data.raw.dead", 1_700_000_000_000L, "small", new byte[10], reasons),
                    TopicRecord.of("data.raw.dead", 1_700_000_000_000L, "large", new byte[17_000_000], reasons));

            StreamExecutionEnvironment env = JobEnvironment.create(options.get());
            env.fromData(letters)
                    .uid("letters")
                    .sinkTo(new DeadLetterSink(options.get(), new TopicOptions.Settings(3, (short) 1, -1L, Set.of())))
                    .uid("sink");
            env.execute();

            TopicDescription topic = admin.describeTopics(List.of("data.raw.dead"))
                    .allTopicNames()
                    .get()
                    .get("data.raw.dead");
            assertThat(topic.partitions()).hasSize(3);
            assertThat(written(kafka, 2))
                    .containsEntry("small", "why")
                    .hasEntrySatisfying("large", message -> assertThat(message).startsWith("why (truncated to 16"));
        }
    }

    /** Messages by key. */
    private static Map<String, String> written(EmbeddedKafka kafka, int letters) {
        Map<String, Object> settings =
                Map.of("bootstrap.servers", kafka.bootstrapServers(), "auto.offset.reset", "earliest");
        Map<String, String> messages = new HashMap<>();
        try (var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            consumer.assign(consumer.partitionsFor("data.raw.dead").stream()
                    .map(info -> new TopicPartition(info.topic(), info.partition()))
                    .toList());
            while (messages.size() < letters) { // ended by the class's timeout
                consumer.poll(Duration.ofMillis(200))
                        .forEach(record -> messages.put(
                                new String(record.key(), UTF_8),
                                new String(
                                        record.headers()
                                                .lastHeader(DeadLetter.MESSAGE)
                                                .value(),
                                        UTF_8)));
            }
        }
        return messages;
    }
}
