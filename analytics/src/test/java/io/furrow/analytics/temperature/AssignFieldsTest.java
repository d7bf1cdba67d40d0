package io.furrow.analytics.temperature;

import java.util.List;

import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithNonKeyedOperator;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.TwoInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.field.FieldRecords;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.position.Position;

import static org.assertj.core.api.Assertions.assertThat;

class AssignFieldsTest {
    private final FieldRecords fields = new FieldRecords();

    @AutoClose
    private TwoInputStreamOperatorTestHarness<Reading, TopicRecord, FieldReading> operator;

    @Test
    void knowsTheFieldsBeforeTheStreamOfThemHasBroughtAny() throws Exception {
        fields.square("north", 100, "canary");
        open();
        read(100);
        read(99);

        assertThat(operator.extractOutputValues())
                .extracting(FieldReading::field, FieldReading::domain, FieldReading::validFrom)
                .containsExactly(org.assertj.core.groups.Tuple.tuple("north", "canary", 100L));
    }

    @Test
    void joinsALateReadingWithTheFieldAsItWas() throws Exception {
        open();
        change(fields.square("north", 100, "canary"));
        change(fields.square("north", 200, "dairy"));
        change(fields.end("north", 300));
        read(300);
        read(250);
        read(150);

        assertThat(operator.extractOutputValues())
                .extracting(FieldReading::domain)
                .containsExactly("dairy", "canary");
    }

    @Test
    void knowsAfterARestartWhatCameWhileItWasDown() throws Exception {
        fields.square("north", 100, "canary");
        open();
        read(150);
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        fields.end("north", 200);
        create();
        operator.initializeState(snapshot);
        operator.open();
        read(150);
        read(200);

        assertThat(operator.extractOutputValues()).hasSize(1);
        assertThat(operator.getOperator()
                        .getOperatorStateBackend()
                        .getBroadcastState(FieldVersions.BROADCAST)
                        .entries())
                .as("the topic is the state")
                .isEmpty();
    }

    private void open() throws Exception {
        create();
        operator.open();
    }

    private void create() throws Exception {
        operator = new TwoInputStreamOperatorTestHarness<>(new CoBroadcastWithNonKeyedOperator<>(
                new AssignFields(fields.atStart()), List.of(FieldVersions.BROADCAST)));
    }

    private void change(TopicRecord record) throws Exception {
        operator.processElement2(new StreamRecord<>(record));
    }

    private void read(long time) throws Exception {
        Reading reading = new Reading(
                "t1", "Thermometer", Farm.SCOPE, new Position(55, 15), 18, "id-" + time, Farm.north("t1", 18, time));
        operator.processElement1(new StreamRecord<>(reading, time));
    }
}
