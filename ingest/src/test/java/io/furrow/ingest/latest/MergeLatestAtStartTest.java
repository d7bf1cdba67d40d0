package io.furrow.ingest.latest;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** A job that starts without state where {@code data.latest} holds some. */
@SuppressWarnings("try") // closing the harness may be interrupted
class MergeLatestAtStartTest {
    private static final Duration KEPT = Duration.ofMillis(1000);
    private static final int KEY_GROUPS = 8;

    /** What was written comes to be on the topic. */
    private final ArrayList<TopicRecord> topic = new ArrayList<>();

    private LatestKey key = LatestKey.ID;

    private record OnTheTopic(ArrayList<TopicRecord> records) implements TopicSnapshot {
        @Override
        public List<TopicRecord> read() {
            return records;
        }
    }

    @ParameterizedTest
    @EnumSource
    void addsAPartToTheWhole(LatestKey keyOfTheTopic) throws Exception {
        key = keyOfTheTopic;
        run(null, report("robot", 200, robot("robot").number("speed", 2).number("fuel", 50)));

        List<TopicRecord> written =
                run(null, report("robot", 300, robot("robot").number("speed", 3)));

        assertThat(written).singleElement().satisfies(record -> {
            assertThat(record.timestamp()).isEqualTo(300);
            assertThat(Entity.parse(record.value()).number("speed")).contains(3.0);
            assertThat(Entity.parse(record.value()).number("fuel")).contains(50.0);
        });
    }

    @Test
    void putsNothingOlderInThePlaceOfWhatIsNewer() throws Exception {
        run(null, report("robot", 200, robot("robot").number("speed", 2)));

        assertThat(run(null, report("robot", 100, robot("robot").number("speed", 1))))
                .isEmpty();
    }

    @Test
    void beginsWithTheNewestAlsoWhereAnOlderOneWasBroughtBackBehindIt() throws Exception {
        topic.add(robotOfTheTopic(300));
        topic.add(robotOfTheTopic(200));

        assertThat(run(null, report("robot", 250, robot("robot").number("speed", 1))))
                .isEmpty();
    }

    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void letsWhatIsFromTheFutureBeReplaced(boolean deleted) throws Exception {
        long future = System.currentTimeMillis() + Duration.ofDays(1).toMillis();
        TopicRecord known = robotOfTheTopic(future);
        topic.add(deleted ? TopicRecord.of(Topics.LATEST, future, "robot", null, known.headers()) : known);

        assertThat(run(null, report("robot", 300, robot("robot").number("speed", 3))))
                .singleElement()
                .satisfies(record -> assertThat(record.timestamp()).isEqualTo(300));
    }

    @Test
    void knowsWhatWasDeletedAndForgetsItInTime() throws Exception {
        run(null, report("robot", 100, robot("robot").number("speed", 2)), deletion("robot", 200));

        try (var operator = open(null, 0, 1)) {
            process(operator, report("robot", 150, robot("robot").number("speed", 1)));
            assertThat(operator.extractOutputValues()).isEmpty();
            operator.processWatermark(1200);
            assertThat(operator.numKeyedStateEntries()).isZero();
            assertThat(operator.numEventTimeTimers()).isZero();
        }
    }

    @Test
    void knowsWhichOfSeveralTypesHasTheIdAsItsKey() throws Exception {
        run(
                null,
                report("e-13", 100, Entity.builder("e-13", "Valve").number("level", 1)),
                report("e-13", 100, Entity.builder("e-13", "Pump").number("level", 2)));
        topic.remove(0);
        topic.add(topic.remove(0)); // the valve reports nothing more, compaction keeps the order of the newest

        List<TopicRecord> written = run(
                null,
                report("e-13", 200, Entity.builder("e-13", "Pump").number("rate", 3)),
                report("e-13", 200, Entity.builder("e-13", "Valve").number("rate", 4)));

        assertThat(written)
                .extracting(record -> new String(record.key(), UTF_8))
                .containsExactly("e-13 Pump", "e-13");
        assertThat(Entity.parse(written.get(0).value()).number("level")).contains(2.0);
    }

    @Test
    void readsTheTopicOnce() throws Exception {
        run(null, report("robot", 200, robot("robot").number("speed", 2)));
        OperatorSubtaskState taken;
        try (var operator = open(null, 0, 1)) {
            taken = operator.snapshot(1, 1);
        }
        topic.clear();

        List<TopicRecord> written =
                run(taken, report("robot", 300, robot("robot").number("fuel", 50)));

        assertThat(Entity.parse(written.get(0).value()).number("speed"))
                .as("it is in the savepoint, though no event has come of it")
                .contains(2.0);
        topic.add(robotOfTheTopic(400));
        assertThat(run(taken, report("robot", 300, robot("robot").number("fuel", 50))))
                .as("who has state does not look at the topic")
                .hasSize(1);
    }

    @Test
    void takesTheNewestOfSeveralRecordsAndPassesOverWhatIsNone() throws Exception {
        topic.add(robotOfTheTopic(100));
        topic.add(robotOfTheTopic(200));
        topic.add(new TopicRecord(Topics.LATEST, 0, 2, 200, utf8("other"), utf8("no entity"), Map.of()));
        topic.add(new TopicRecord(Topics.LATEST, 0, 3, 200, null, utf8("no key"), Map.of()));

        assertThat(run(null, report("robot", 150, robot("robot").number("speed", 1))))
                .isEmpty();
    }

    @Test
    void keepsAtEachSubtaskTheEntitiesOfItsKeys() throws Exception {
        for (int number = 0; number < 20; number++) {
            run(null, report("r" + number, 200, robot("r" + number).number("speed", 2)));
        }
        int entries = 0;
        for (int subtask = 0; subtask < 3; subtask++) {
            try (var operator = open(null, subtask, 3)) {
                assertThat(operator.numKeyedStateEntries()).isBetween(1, 19);
                entries += operator.numKeyedStateEntries();
            }
        }
        assertThat(entries).isEqualTo(20);
    }

    private List<TopicRecord> run(OperatorSubtaskState state, ReportedEvent... events) throws Exception {
        try (var operator = open(state, 0, 1)) {
            for (ReportedEvent event : events) {
                process(operator, event);
            }
            List<TopicRecord> written = operator.extractOutputValues();
            topic.addAll(written);
            return written;
        }
    }

    private static void process(
            KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, TopicRecord> operator, ReportedEvent event)
            throws Exception {
        operator.processElement(event, event.time());
    }

    private KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, TopicRecord> open(
            OperatorSubtaskState state, int subtask, int subtasks) throws Exception {
        var operator = new KeyedOneInputStreamOperatorTestHarness<>(
                new MergeLatestOperator(
                        new MergeLatest(KEPT, key), key, new OnTheTopic(new ArrayList<>(topic)), Duration.ofHours(1)),
                ReportedEvent::identity,
                Types.STRING,
                KEY_GROUPS,
                subtasks,
                subtask);
        if (state != null) {
            operator.initializeState(state);
        }
        operator.open();
        return operator;
    }

    private static TopicRecord robotOfTheTopic(long time) {
        byte[] value = robot("robot").number("speed", time).toBytes();
        Map<String, String> headers = Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/");
        return new TopicRecord(Topics.LATEST, 0, time, time, utf8("robot"), value, headers);
    }

    private static EntityBuilder robot(String id) {
        return Entity.builder(id, "Robot");
    }

    private static ReportedEvent report(String id, long time, EntityBuilder entity) {
        return event(id, entity.type(), time, entity.toBytes());
    }

    private static ReportedEvent deletion(String id, long time) {
        return event(id, "", time, null);
    }

    private static ReportedEvent event(String id, String type, long time, byte[] value) {
        var headers = Map.of(HeaderNames.CE_ID, "e" + time, HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/");
        TopicRecord record = TopicRecord.of(Topics.RAW, time, id, value, headers);
        return new ReportedEvent("e" + time, "farm|/|" + id, id, type, "", "", record);
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }
}
