package io.furrow.ingest.route;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithKeyedOperator;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedTwoInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;

import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Runs {@link AssignMission} on devices in the default scope, so that {@code |/|robot} is the identity of {@code robot}. */
abstract class AssignMissionFixture {
    static final AssignMission.Rule RULE = new AssignMission.Rule(Duration.ofMillis(1000), "home", "");

    static final int BUDGET = 20;

    final ArrayList<TopicRecord> snapshot = new ArrayList<>();
    final ArrayList<TopicRecord> domains = new ArrayList<>();
    final ArrayList<TopicRecord> missions = new ArrayList<>();
    final HashSet<String> topics = new HashSet<>();

    @AutoClose
    KeyedTwoInputStreamOperatorTestHarness<String, ReportedEvent, DeviceChange, ReportedEvent> operator;

    @BeforeEach
    void open() throws Exception {
        create();
        operator.open();
    }

    List<TopicRecord> deadLetters() {
        List<TopicRecord> deadLetters = new ArrayList<>();
        operator.getSideOutput(DeadLetters.TAG).forEach(record -> deadLetters.add(record.getValue()));
        return deadLetters;
    }

    static TopicRecord managed(String name, String json) {
        return serviceRecord(name, json.replace('\'', '"').getBytes(UTF_8));
    }

    static TopicRecord serviceRecord(String name, byte[] value) {
        return new TopicRecord("service", 0, 0, 0, name.getBytes(UTF_8), value, Map.of());
    }

    void create() throws Exception {
        create(RULE);
    }

    void create(AssignMission.Rule rule) throws Exception {
        List<TopicRecord> records = List.copyOf(snapshot);
        operator = new KeyedTwoInputStreamOperatorTestHarness<>(
                new CoBroadcastWithKeyedOperator<>(
                        new AssignMission(
                                new FixedSnapshot(records),
                                rule,
                                new NameBudget(
                                        new FixedSnapshot(domains),
                                        new FixedSnapshot(missions),
                                        () -> Set.copyOf(topics),
                                        true,
                                        BUDGET)),
                        List.of(AssignMission.DEVICES)),
                ReportedEvent::identity,
                null,
                Types.STRING);
    }

    /** Not actually serializable; the harness never serializes it. */
    record FixedSnapshot(List<TopicRecord> records) implements TopicSnapshot {
        @Override
        public List<TopicRecord> read() {
            return records;
        }
    }

    void report(String id, long time, String domain, String mission) throws Exception {
        event(id, time, time, domain, mission, new byte[0]);
    }

    void delete(String id, long time) throws Exception {
        event(id, time, time, "", "", null);
    }

    void event(String id, long time, long received, String domain, String mission, byte[] value) throws Exception {
        Map<String, String> headers = Map.of(HeaderNames.TS_SOURCE, Long.toString(received));
        TopicRecord record = TopicRecord.of(Topics.RAW, time, id, value, headers);
        operator.processElement1(
                new StreamRecord<>(new ReportedEvent("e", "|/|" + id, id, "Robot", domain, mission, record), time));
    }

    List<String> routes() {
        return operator.extractOutputValues().stream()
                .map(event -> event.domain() + "/" + event.mission())
                .toList();
    }
}
