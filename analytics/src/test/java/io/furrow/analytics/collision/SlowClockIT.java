package io.furrow.analytics.collision;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** An encounter on one partition; on the other, one robot whose clock is two hours behind. */
@Timeout(120)
@Tag("full")
class SlowClockIT {
    private static final long BEHIND = Duration.ofHours(2).toMillis();

    private KafkaProducer<byte[], byte[]> producer;

    /** At two, a subtask of the source has nothing but the slow clock. At last, all clocks are equally slow. */
    @ParameterizedTest
    @CsvSource({"1, 0", "2, 0", "1, 7200000", "2, 7200000"})
    void tellsTheEncounter(String parallelism, long behind, @TempDir Path dir) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(dir.resolve("kafka"));
                EmbeddedFlink flink = EmbeddedFlink.start(2, 0);
                KafkaConsumer<byte[], byte[]> results = new KafkaConsumer<>(
                        Map.of("bootstrap.servers", kafka.bootstrapServers()),
                        new ByteArrayDeserializer(),
                        new ByteArrayDeserializer())) {
            producer =
                    new KafkaProducer<>(kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer());
            kafka.createTopics(List.of(
                    new NewTopic(Topics.RAW, 2, (short) 1),
                    new NewTopic(Topics.DEVICES, 1, (short) 1),
                    new NewTopic(Topics.COLLISION, 1, (short) 1)));
            results.assign(List.of(new TopicPartition(Topics.COLLISION, 0)));
            results.seekToBeginning(results.assignment());
            flink.submit(CollisionJob.assemble(ReportedRun.options(
                            "--bootstrap-servers", kafka.bootstrapServers(), "--parallelism", parallelism))
                    .getStreamGraph());

            List<Entity> told = new ArrayList<>();
            await().pollInSameThread()
                    .pollInterval(Duration.ofMillis(500))
                    .atMost(Duration.ofSeconds(45))
                    .untilAsserted(() -> {
                        long now = System.currentTimeMillis();
                        report(0, now, ReportedRun.robot("r1", 0, 0).at(now - behind));
                        report(0, now, ReportedRun.robot("r2", 2, 0).at(now - behind));
                        report(1, now, ReportedRun.robot("slow", 900, 0).at(now - BEHIND));
                        results.poll(Duration.ofMillis(100)).forEach(record -> told.add(entity(record.value())));
                        assertThat(told)
                                .first()
                                .satisfies(entity ->
                                        assertThat(entity.text("phase")).contains("started"));
                    });
            producer.close();
        }
    }

    private void report(int partition, long received, TopicRecord record) {
        var out = new ProducerRecord<>(Topics.RAW, partition, record.timestamp(), record.key(), record.value());
        record.with(HeaderNames.TS_SOURCE, Long.toString(received))
                .headers()
                .forEach((name, text) -> out.headers().add(name, text.getBytes(UTF_8)));
        producer.send(out);
    }

    private static Entity entity(byte[] value) throws AssertionError {
        try {
            return Entity.parse(value);
        } catch (io.furrow.model.ngsi.UnreadableException e) {
            throw new AssertionError("what the job wrote is an entity", e);
        }
    }
}
