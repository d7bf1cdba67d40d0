package io.furrow.ingest;

import java.nio.file.Path;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.Random;

import org.apache.flink.api.common.JobID;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;

@Timeout(180)
@Tag("full")
class TooLargeRecordsIT {
    private static final int SMALL = 2_000;
    private static final int EVENTS = 2_000;

    @TempDir
    static Path directory;

    /** Not long ago: the broker's retention goes by the record timestamp. */
    private static final long TIME = System.currentTimeMillis() - 60_000;

    @AutoClose
    private static KafkaSuite suite;

    @BeforeAll
    static void start() {
        suite = KafkaSuite.start(directory.resolve("kafka"));
    }

    @ParameterizedTest
    @ValueSource(strings = {"at-least-once", "exactly-once"})
    void becomeDeadLettersOfTheTopicThatDoesNotTakeThem(String delivery) throws Exception {
        String in = "in-" + delivery;
        String ofMission = "data.%s.realtime.m".formatted(delivery);
        suite.makeTopic(in, 1);
        suite.makeTopic(ofMission, 1, Map.of("max.message.bytes", Integer.toString(SMALL)));
        suite.makeTopic(ofMission + ".dead", 1, Map.of("max.message.bytes", Integer.toString(SMALL)));
        for (int number = 0; number < EVENTS; number++) {
            report(in, number, delivery, number == EVENTS / 2 ? 3 * SMALL : 500);
        }

        JobID job = suite.run(null, "--input", in, "--parallelism", "1", "--delivery", delivery);

        List<ConsumerRecord<byte[], byte[]>> taken = suite.awaitRecords(ofMission, EVENTS - 1);
        assertThat(taken).as("all but one, once: the job was not restarted").hasSize(EVENTS - 1);
        assertThat(suite.awaitRecords("data.%s.realtime".formatted(delivery), EVENTS))
                .as("another topic takes it")
                .hasSize(EVENTS);
        assertThat(suite.awaitRecords(ofMission + ".dead", 1)).singleElement().satisfies(letter -> {
            assertThat(letter.serializedValueSize()).isLessThan(SMALL);
            assertThat(KafkaSuite.headers(letter))
                    .containsEntry(DeadLetter.REASON, "too-large")
                    .containsEntry(HeaderNames.CE_ID, delivery + EVENTS / 2)
                    .hasEntrySatisfying(
                            DeadLetter.MESSAGE,
                            message -> assertThat(message)
                                    .contains(ofMission + " takes records of at most 2000 bytes", "(truncated to "));
        });
        suite.cancel(job);
    }

    private static void report(String topic, int number, String domain, int size) {
        String entity = """
                {"id": "e%d", "type": "T", "Domain": {"type": "String", "value": "%s", "metadata": {}}, \
                "Mission": {"type": "String", "value": "m", "metadata": {}}, \
                "Note": {"type": "Text", "value": "%s", "metadata": {}}}""".formatted(number, domain, incompressible(size));
        suite.write(topic, 0, TIME + number, "e" + number, entity, Map.of(HeaderNames.CE_ID, domain + number));
    }

    /** Else a record would fit when it is compressed. */
    private static String incompressible(int size) {
        byte[] random = new byte[size / 2];
        new Random(size).nextBytes(random);
        return HexFormat.of().formatHex(random);
    }
}
