package io.furrow.mission.topic;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.ObjectInputStream;
import java.io.ObjectOutputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

@Tag("full")
class TopicRecordingsIT {
    private static final PageLimits ALL = new PageLimits(1_000_000, Integer.MAX_VALUE);
    private static final long NO_END = Long.MAX_VALUE;

    @TempDir
    static Path log;

    @TempDir
    Path temporary;

    @AutoClose
    private static EmbeddedKafka kafka;

    @AutoClose
    private static Admin admin;

    @BeforeAll
    static void start() {
        kafka = EmbeddedKafka.start(log);
        admin = Admin.create(kafka.client());
    }

    @Test
    void readsTheEventsOfATopicInTheirOrder() throws Exception {
        create("data.farm.realtime");
        try (KafkaProducer<String, String> producer = producer(Map.of())) {
            send(producer, event("data.farm.realtime", 2, 30, "c", "{\"id\":\"t3\",\"type\":\"T\"}"));
            send(producer, event("data.farm.realtime", 0, 20, "b", "{\"id\":\"t2\",\"type\":\"T\"}"));
            send(producer, event("data.farm.realtime", 1, 20, "a", null));
            send(producer, event("data.farm.realtime", 3, 10, null, "{\"id\":\"t1\",\"type\":\"T\"}"));
            send(producer, event("data.farm.realtime", 3, 20, "b", "{\"id\":\"t2\",\"type\":\"Copy\"}"));
            send(producer, event("data.farm.realtime", 3, 40, "late", "{\"id\":\"t1\",\"type\":\"T\"}"));
        }

        try (Recording recording = recordings(40).open("data.farm.realtime").orElseThrow()) {
            EventPage eventPage = recording.read(Cursor.START, ALL);

            assertThat(eventPage.events())
                    .extracting(event -> event.time() + " " + event.id() + " " + event.entityId() + " "
                            + (event.entity() == null
                                    ? "deleted"
                                    : event.entity().path("type").asText()))
                    .containsExactly("10 data.farm.realtime-3-0 t1 T", "20 a key deleted", "20 b t2 T", "30 c t3 T");
            assertThat(eventPage.events().get(2).headers()).isEqualTo(Map.of("fiware-service", "farm"));
            assertThat(eventPage.skipped()).isEmpty();
            assertThat(recording.span()).contains(new RecordingExtent(10, 30));
            assertThat(recording.read(eventPage.next(), ALL).events()).isEmpty();
            assertThat(recording.read(Cursor.before(20), new PageLimits(1, 1)).events())
                    .extracting(StoredEvent::id)
                    .containsExactly("a");
            assertThat(recording.back(Cursor.before(25), Cursor.START, 2, event -> true, ALL))
                    .isEqualTo(new Cursor(10, "data.farm.realtime-3-0"));
            assertThat(recording.stateBefore(30, Set.of(), PageLimits.DEFAULT)).hasSize(2);
        }
    }

    @Test
    void givesRecordsTheSameIdsInEveryLanguage() throws Exception {
        create("data.arabic");
        try (KafkaProducer<String, String> producer = producer(Map.of())) {
            send(producer, event("data.arabic", 3, 10, null, "{\"id\":\"t1\",\"type\":\"T\"}"));
        }
        Locale usual = Locale.getDefault();
        Locale.setDefault(Locale.forLanguageTag("ar-EG"));
        try {
            assertThat(ids(recordings(NO_END), "data.arabic")).containsExactly("data.arabic-3-0");
        } finally {
            Locale.setDefault(usual);
        }
    }

    @Test
    void rejectsATopicLargerThanTheDiskAndDeletesItsFiles() throws Exception {
        create("data.large");
        try (KafkaProducer<String, String> producer = producer(Map.of())) {
            send(producer, event("data.large", 3, 10, null, "{\"id\":\"t1\",\"type\":\"T\"}"));
        }

        assertThatThrownBy(() -> recordings(NO_END)
                        .open("data.large", folder -> new DiskSpace(folder, 1_000_000, () -> 1_000_001)))
                .isInstanceOf(RecordingDeletedException.class)
                .hasMessageContaining("do not fit into " + temporary);
        assertThat(temporary).isEmptyDirectory();
    }

    @Test
    void readsCommittedRecords() throws Exception {
        create("data.committed");
        try (KafkaProducer<String, String> producer = producer(Map.of("transactional.id", "one"))) {
            producer.initTransactions();
            producer.beginTransaction();
            producer.send(event("data.committed", 0, 1, "a", "{\"id\":\"t\",\"type\":\"T\"}"));
            producer.commitTransaction();
            producer.beginTransaction();
            producer.send(event("data.committed", 0, 2, "aborted", "{\"id\":\"t\",\"type\":\"T\"}"));
            producer.abortTransaction();
            assertThat(ids(recordings(NO_END), "data.committed")).containsExactly("a");

            producer.beginTransaction();
            producer.send(event("data.committed", 0, 3, "b", "{\"id\":\"t\",\"type\":\"T\"}"))
                    .get();
            assertThat(ids(recordings(NO_END), "data.committed")).containsExactly("a");
            producer.commitTransaction();
        }
        assertThat(ids(recordings(NO_END), "data.committed")).containsExactly("a", "b");
    }

    @Test
    void countsInvalidRecords() throws Exception {
        create("data.broken");
        try (KafkaProducer<String, String> producer = producer(Map.of())) {
            send(producer, event("data.broken", 0, 1, "a", "nonsense"));
            send(producer, event("data.broken", 0, 2, "b", "{\"type\":\"T\"}"));
            send(producer, new ProducerRecord<>("data.broken", 0, 3L, (String) null, (String) null));
            send(producer, event("data.broken", 0, 4, "c", "{\"id\":\"t\",\"type\":\"T\"}"));
        }
        try (Recording recording = recordings(NO_END).open("data.broken").orElseThrow()) {
            EventPage eventPage = recording.read(Cursor.START, ALL);

            assertThat(eventPage.events()).extracting(StoredEvent::id).containsExactly("c");
            assertThat(eventPage.skipped()).hasSize(1).allSatisfy(skippedRecords -> {
                assertThat(skippedRecords.what()).isEqualTo("records of data.broken");
                assertThat(skippedRecords.reason()).startsWith("the first is partition 0, offset 0: ");
                assertThat(skippedRecords.count()).isEqualTo(3);
            });
            assertThat(recording.read(Cursor.before(0), ALL).skipped()).isEqualTo(List.<SkippedRecords>of());
        }
    }

    @Test
    void deletesItsFiles() throws Exception {
        create("data.small");
        TopicRecordings recordings = recordings(NO_END);
        Recording empty = recordings.open("data.small").orElseThrow();
        assertThat(empty.span()).isEmpty();
        assertThat(temporary).isNotEmptyDirectory();

        empty.close();
        empty.close();

        assertThat(temporary).isEmptyDirectory();
        Thread.currentThread().interrupt();
        assertThatThrownBy(() -> recordings.open("data.small")).isInstanceOf(RecordingInterruptedException.class);
        assertThat(Thread.interrupted()).isTrue();
        assertThat(temporary).isEmptyDirectory();
    }

    @Test
    void opensNoMissingTopicAndRejectsTopicsWithoutEvents() throws Exception {
        assertThat(recordings(NO_END).open("data.nowhere")).isEmpty();
        assertThat(admin.listTopics().names().get()).doesNotContain("data.nowhere");
        assertThatThrownBy(() -> recordings(NO_END).open("service.missions"))
                .isInstanceOf(RecordingDeletedException.class)
                .hasMessage("Topic service.missions holds no events; name one that begins with data.");
    }

    @Test
    void reportsWhatIsUnavailable() throws Exception {
        create("data.away");
        int port = FreePort.orFree(0);
        TopicRecordings unavailable = new TopicRecordings(
                Map.of("bootstrap.servers", "127.0.0.1:" + port, "default.api.timeout.ms", "500"), NO_END);
        assertThatThrownBy(() -> unavailable.open("data.away"))
                .isInstanceOf(RecordingException.class)
                .hasMessageStartingWith("Topic data.away cannot be read from Kafka at 127.0.0.1:" + port)
                .hasMessageEndingWith("Check that Kafka runs there and answers.");

        Path file = Files.createFile(temporary.resolve("file"));
        TopicRecordings nowhere = new TopicRecordings(recordings(NO_END).kafka(), NO_END, file.toString());
        assertThatThrownBy(() -> nowhere.open("data.away"))
                .isInstanceOf(RecordingException.class)
                .hasMessageStartingWith("Topic data.away cannot be sorted in " + file)
                .hasMessageEndingWith("Check that the folder can be written and has room.");
    }

    @Test
    void isSerializable() throws Exception {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        try (ObjectOutputStream objects = new ObjectOutputStream(out)) {
            objects.writeObject(recordings(7));
        }
        try (ObjectInputStream objects = new ObjectInputStream(new ByteArrayInputStream(out.toByteArray()))) {
            assertThat(objects.readObject()).isEqualTo(recordings(7));
        }
    }

    private TopicRecordings recordings(long until) {
        TopicRecordings plain = new TopicRecordings(Map.of("bootstrap.servers", kafka.bootstrapServers()), until);
        return new TopicRecordings(plain.kafka(), until, temporary.toString());
    }

    private static void create(String topic) throws Exception {
        kafka.createTopics(List.of(new NewTopic(topic, 4, (short) 1)));
    }

    private static KafkaProducer<String, String> producer(Map<String, Object> more) {
        Map<String, Object> settings = new HashMap<>(kafka.producerSettings());
        settings.putAll(more);
        return new KafkaProducer<>(settings, new StringSerializer(), new StringSerializer());
    }

    private static ProducerRecord<String, String> event(
            String topic, int partition, long time, String id, String entity) {
        ProducerRecord<String, String> event = new ProducerRecord<>(topic, partition, time, "key", entity);
        event.headers().add("fiware-service", "farm".getBytes(UTF_8));
        if (id != null) {
            event.headers().add("ce_id", id.getBytes(UTF_8));
        }
        return event;
    }

    private static void send(KafkaProducer<String, String> producer, ProducerRecord<String, String> event)
            throws Exception {
        producer.send(event).get();
    }

    private static List<String> ids(TopicRecordings recordings, String topic) throws Exception {
        try (Recording recording = recordings.open(topic).orElseThrow()) {
            return recording.read(Cursor.START, ALL).events().stream()
                    .map(StoredEvent::id)
                    .toList();
        }
    }
}
