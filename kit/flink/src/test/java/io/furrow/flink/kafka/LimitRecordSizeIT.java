package io.furrow.flink.kafka;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.LongSupplier;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AlterConfigOp;
import org.apache.kafka.clients.admin.ConfigEntry;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.errors.RecordTooLargeException;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Timeout(120)
@Tag("full")
class LimitRecordSizeIT {
    private static final int SMALL = 2_000;
    private static final int SLACK = 100;

    @TempDir
    static Path directory;

    @AutoClose
    private static EmbeddedKafka kafka;

    @AutoClose
    private static Admin admin;

    @BeforeAll
    static void start() {
        kafka = EmbeddedKafka.start(directory);
        admin = Admin.create(kafka.client());
    }

    @Test
    void putTheDeadLetterInThePlaceOfWhatATopicDoesNotTake() throws Exception {
        makeTopic("small", SMALL);
        byte[] large = new byte[SMALL];
        try (LimitRecordSize records = writable(new Properties())) {
            TopicRecord fits = record("small", new byte[SMALL - 3 * SLACK]);
            assertThat(records.of(fits)).isSameAs(fits);

            TopicRecord letter = records.of(record("small", large));
            assertThat(letter.topic()).isEqualTo("small.dead");
            assertThat(letter.value()).isEqualTo(large);
            assertThat(letter.key()).isEqualTo("k".getBytes(UTF_8));
            assertThat(letter.headers())
                    .containsEntry("ce_id", "7f")
                    .containsEntry(DeadLetter.REASON, Reason.TOO_LARGE.code())
                    .containsEntry(DeadLetter.STAGE, "kafka")
                    .hasEntrySatisfying(
                            DeadLetter.MESSAGE,
                            message -> assertThat(message)
                                    .startsWith(
                                            "small takes records of at most 2000 bytes, with key and headers this has up to ")
                                    .endsWith("; event 7f"));
            assertTaken(letter);
        }
    }

    @Test
    void agreeWithTheBrokerByteByByte() throws Exception {
        makeTopic("exact", SMALL);
        try (LimitRecordSize records = writable(new Properties())) {
            for (int bytes = SMALL - 2 * SLACK; bytes < SMALL + SLACK; bytes++) {
                TopicRecord record = record("exact", new byte[bytes]);
                if (records.of(record) == record) {
                    assertTaken(record);
                } else {
                    assertRefused(record);
                }
            }
        }
    }

    @Test
    void weighACompressedRecordAsTheBrokerDoes() throws Exception {
        makeTopic("packed", SMALL);
        Properties gzip = new Properties();
        gzip.setProperty("compression.type", "gzip");
        try (LimitRecordSize records = writable(gzip)) {
            TopicRecord zeroes = record("packed", new byte[50 * SMALL]);
            assertThat(records.of(zeroes)).isSameAs(zeroes);
        }
    }

    @Test
    void shortenALetterThatIsTooLargeItself() throws Exception {
        makeTopic("tiny", SMALL);
        makeTopic("tiny.dead", SMALL);
        try (LimitRecordSize records = writable(new Properties())) {
            TopicRecord letter = records.of(record("tiny", new byte[3 * SMALL]));

            assertThat(letter.topic()).isEqualTo("tiny.dead");
            assertThat(letter.value().length).isBetween(SMALL / 2, SMALL);
            assertThat(letter.headers().get(DeadLetter.MESSAGE))
                    .endsWith(" (truncated to " + letter.value().length + " of 6000 bytes)");
            assertTaken(letter);
        }
    }

    @Test
    void leaveOutHeadersAndKeyWhereNothingElseHelps() throws Exception {
        makeTopic("narrow.dead", SMALL);
        TopicRecord letter = record("narrow.dead", new byte[10])
                .with(new DeadLetter(Reason.NOT_JSON, "why", "ingest", "data.raw-0@1").headers())
                .with("trace", "t".repeat(3 * SMALL));
        try (LimitRecordSize records = writable(new Properties())) {
            TopicRecord left = records.of(letter);

            assertThat(left.headers())
                    .containsOnlyKeys(DeadLetter.REASON, DeadLetter.MESSAGE, DeadLetter.STAGE, DeadLetter.SOURCE);
            assertThat(left.headers()).containsEntry(DeadLetter.MESSAGE, "why (truncated to 0 of 10 bytes)");
            assertThat(left.value()).isEmpty();
            assertThat(left.key()).isNull();
            assertTaken(left);
        }
    }

    @Test
    void respectTheLimitOfTheProducerToo() throws Exception {
        Properties producer = new Properties();
        producer.setProperty("max.request.size", "3000");
        try (LimitRecordSize records = writable(producer)) {
            TopicRecord letter = records.of(record("wide", new byte[5_000]));

            assertThat(letter.topic()).isEqualTo("wide.dead");
            assertThat(letter.headers().get(DeadLetter.MESSAGE)).contains("at most 3000 bytes", "(truncated to ");
            assertThat(RecordSize.atMost(letter)).isBetween(2_900L, 3_000L);
            await().until(() -> admin.listTopics().names().get().contains("wide.dead"));
        }
    }

    @Test
    void refuseATopicThatTakesNotEvenAReason() throws Exception {
        makeTopic("hopeless.dead", 100);
        try (LimitRecordSize records = writable(new Properties())) {
            assertThatThrownBy(() -> records.of(record("hopeless.dead", new byte[10])
                            .with(new DeadLetter(Reason.NOT_JSON, "why", "ingest", "data.raw-0@1").headers())))
                    .isInstanceOf(IOException.class)
                    .hasMessageContainingAll("hopeless.dead", "raise its max.message.bytes");
        }
    }

    @Test
    void doNotWaitForAnotherTopicThatIsBeingMade() throws Exception {
        CountDownLatch asking = new CountDownLatch(1);
        CountDownLatch written = new CountDownLatch(1);
        AtomicReference<String> maker = new AtomicReference<>();
        try (LimitRecordSize records = writable(new Properties(), () -> {
            if (Thread.currentThread().getName().equals(maker.get())) {
                asking.countDown();
                await().until(() -> written.getCount() == 0);
            }
            return System.nanoTime();
        })) {
            CompletableFuture<Integer> partitions = CompletableFuture.supplyAsync(() -> {
                maker.set(Thread.currentThread().getName());
                return prepare(records, "being-made");
            });
            asking.await();
            TopicRecord other = record("another", new byte[SLACK]);

            assertThat(CompletableFuture.supplyAsync(() -> of(records, other)))
                    .succeedsWithin(Duration.ofSeconds(30))
                    .isSameAs(other);
            written.countDown();
            assertThat(partitions.get()).isPositive();
        }
    }

    @Test
    void makeATopicAgainThatWasDeleted() throws Exception {
        try (LimitRecordSize records = writable(new Properties())) {
            assertThat(prepare(records, "deleted")).isPositive();
            admin.deleteTopics(List.of("deleted")).all().get();
            await().until(() -> !admin.listTopics().names().get().contains("deleted"));

            assertThat(prepare(records, "deleted")).isPositive();
        }
    }

    private static int prepare(LimitRecordSize records, String topic) {
        return Unchecked.get(() -> records.prepare(topic));
    }

    private static TopicRecord of(LimitRecordSize records, TopicRecord record) {
        return Unchecked.get(() -> records.of(record));
    }

    @Test
    void readTheLimitOfATopicAnewWhereItWasAskedLongAgo() throws Exception {
        makeTopic("raised", SMALL);
        TopicRecord record = record("raised", new byte[SMALL]);
        AtomicLong nanos = new AtomicLong();
        try (LimitRecordSize records = writable(new Properties(), nanos::get)) {
            assertThat(records.of(record).topic()).isEqualTo("raised.dead");
            raise("raised", 10 * SMALL);
            assertThat(records.of(record).topic()).as("asked just now").isEqualTo("raised.dead");

            nanos.addAndGet(Duration.ofSeconds(11).toNanos());
            assertThat(records.of(record)).isSameAs(record);
        }
    }

    @Test
    void makeATopicAgainThatWasDeletedWhileNothingWasWrittenToIt() throws Exception {
        TopicRecord record = record("deleted", new byte[1]);
        AtomicLong nanos = new AtomicLong();
        try (LimitRecordSize records = writable(new Properties(), nanos::get)) {
            records.of(record);
            admin.deleteTopics(List.of("deleted")).all().get();
            await().until(() -> !admin.listTopics().names().get().contains("deleted"));

            nanos.addAndGet(Duration.ofMinutes(5).toNanos());
            records.of(record);

            assertThat(admin.listTopics().names().get()).contains("deleted");
        }
    }

    private static LimitRecordSize writable(Properties producer) {
        return writable(producer, System::nanoTime);
    }

    private static LimitRecordSize writable(Properties producer, LongSupplier nanoTime) {
        Properties client = kafka.client();
        Properties all = new Properties();
        all.setProperty("max.request.size", Integer.toString(KafkaConnectors.MAX_REQUEST_BYTES));
        all.putAll(producer);
        TopicOptions.Settings settings = new TopicOptions.Settings(null, null, null, Set.of());
        return new LimitRecordSize(new OutputTopics(client, settings, nanoTime), SizeLimits.of(all));
    }

    private static TopicRecord record(String topic, byte[] value) {
        return TopicRecord.of(topic, 1_700_000_000_000L, "k", value, Map.of("ce_id", "7f"));
    }

    private static void makeTopic(String name, int maxBytes) throws Exception {
        NewTopic topic = new NewTopic(name, Optional.of(1), Optional.empty());
        kafka.createTopics(List.of(topic.configs(Map.of("max.message.bytes", Integer.toString(maxBytes)))));
    }

    private static void raise(String topic, int maxBytes) throws Exception {
        ConfigResource resource = new ConfigResource(ConfigResource.Type.TOPIC, topic);
        ConfigEntry entry = new ConfigEntry("max.message.bytes", Integer.toString(maxBytes));
        admin.incrementalAlterConfigs(Map.of(resource, List.of(new AlterConfigOp(entry, AlterConfigOp.OpType.SET))))
                .all()
                .get();
        await().until(() -> admin.describeConfigs(List.of(resource))
                .all()
                .get()
                .get(resource)
                .get("max.message.bytes")
                .value()
                .equals(entry.value()));
    }

    private static void assertTaken(TopicRecord record) throws Exception {
        try (KafkaProducer<byte[], byte[]> producer = producer()) {
            producer.send(new TopicRecordSchema().serialize(record, null, null)).get();
        }
    }

    private static void assertRefused(TopicRecord record) {
        try (KafkaProducer<byte[], byte[]> producer = producer()) {
            assertThatThrownBy(() -> producer.send(new TopicRecordSchema().serialize(record, null, null))
                            .get())
                    .isInstanceOf(ExecutionException.class)
                    .hasCauseInstanceOf(RecordTooLargeException.class);
        }
    }

    private static KafkaProducer<byte[], byte[]> producer() {
        Map<String, Object> settings = Map.of(
                "bootstrap.servers", kafka.bootstrapServers(), "max.request.size", KafkaConnectors.MAX_REQUEST_BYTES);
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }
}
