package io.furrow.flink.time;

import java.time.Duration;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.runtime.jobgraph.OperatorID;
import org.apache.flink.runtime.metrics.groups.InternalOperatorMetricGroup;
import org.apache.flink.runtime.metrics.groups.UnregisteredMetricGroups.UnregisteredTaskMetricGroup;
import org.apache.flink.runtime.metrics.util.InterceptingOperatorMetricGroup;
import org.apache.flink.runtime.operators.testutils.MockEnvironmentBuilder;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** Events are texts {@code <entity>:<id>}. */
class DeduplicateByIdTest {
    private static final Duration WINDOW = Duration.ofSeconds(10);
    /** The window and two tenths of it, after which an id is surely forgotten. */
    private static final long FORGOTTEN = WINDOW.toMillis() * 12 / 10;

    private OperatorMetrics metrics;

    @AutoClose
    private KeyedOneInputStreamOperatorTestHarness<String, String, String> operator;

    @BeforeEach
    void open() throws Exception {
        create();
        operator.open();
    }

    @Test
    void passesTheFirstAndCountsTheRepeats() throws Exception {
        operator.processElement("robot:1", 0);
        operator.processElement("robot:1", 0);
        operator.processElement("robot:2", 1);
        operator.processElement("robot:1", 5_000);

        assertThat(operator.extractOutputValues()).containsExactly("robot:1", "robot:2");
        assertThat(repeated()).isEqualTo(2);
    }

    @Test
    void keepsTheIdsOfEntitiesApart() throws Exception {
        operator.processElement("robot:1", 0);
        operator.processElement("camera:1", 0);
        operator.processElement("camera:1", 0);

        assertThat(operator.extractOutputValues()).containsExactly("robot:1", "camera:1");
    }

    @Test
    void remembersForTheWholeWindowAndForgetsSoonAfter() throws Exception {
        operator.processElement("robot:1", 500);
        operator.processWatermark(500 + WINDOW.toMillis());
        operator.processElement("robot:1", 500);
        assertThat(operator.extractOutputValues()).containsExactly("robot:1");

        operator.processWatermark(500 + FORGOTTEN);
        operator.processElement("robot:1", 500);

        assertThat(operator.extractOutputValues()).containsExactly("robot:1", "robot:1");
    }

    @Test
    void remembersALateEventFromTheWatermarkOn() throws Exception {
        operator.processWatermark(1_000_000);
        operator.processElement("robot:1", 0);
        operator.processWatermark(1_000_000 + WINDOW.toMillis());
        operator.processElement("robot:1", 0);

        assertThat(operator.extractOutputValues()).containsExactly("robot:1");
        assertThat(repeated()).isEqualTo(1);
    }

    @Test
    void remembersALateEventFromTheWatermarkOfAnEarlierRunOn() throws Exception {
        operator.processWatermark(1_000_000);
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        create();
        operator.initializeState(snapshot);
        operator.open();
        operator.processElement("robot:1", 0);
        operator.processWatermark(1_000_000 + WINDOW.toMillis());
        operator.processElement("robot:1", 0);

        assertThat(operator.extractOutputValues()).containsExactly("robot:1");
    }

    @Test
    void leavesNoStateAndNoTimers() throws Exception {
        for (int i = 0; i < 1000; i++) {
            operator.processElement((i % 7) + ":" + i, i * 10L);
        }
        assertThat(operator.numKeyedStateEntries()).isPositive();
        assertThat(operator.numEventTimeTimers())
                .as("a tenth of the window apart")
                .isBetween(7, 7 * 12);

        operator.processWatermark(10_000 + FORGOTTEN);

        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();
    }

    @Test
    void remembersAndForgetsAcrossARestart() throws Exception {
        operator.processElement("robot:1", 0);
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();

        create();
        operator.initializeState(snapshot);
        operator.open();
        operator.processElement("robot:1", 0);
        operator.processElement("robot:2", 0);
        assertThat(operator.extractOutputValues()).containsExactly("robot:2");
        assertThat(repeated()).isEqualTo(1);

        operator.processWatermark(FORGOTTEN);
        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();
    }

    private void create() throws Exception {
        metrics = new OperatorMetrics();
        operator = new KeyedOneInputStreamOperatorTestHarness<>(
                new KeyedLatenessOperator<>(new DeduplicateById<String>(WINDOW, event -> event.split(":")[1])),
                event -> event.split(":")[0],
                Types.STRING,
                new MockEnvironmentBuilder().setMetricGroup(metrics).build());
    }

    private long repeated() {
        return ((Counter) metrics.operator.get("repeated")).getCount();
    }

    /** Keeps the metrics that the operator registers, which the harness would drop. */
    private static final class OperatorMetrics extends UnregisteredTaskMetricGroup {
        private final InterceptingOperatorMetricGroup operator = new InterceptingOperatorMetricGroup();

        @Override
        public InternalOperatorMetricGroup getOrAddOperator(OperatorID id, String name, Map<String, String> variables) {
            return operator;
        }
    }
}
