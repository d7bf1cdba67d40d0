package io.furrow.analytics.collision.grid;

import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithKeyedOperator;
import org.apache.flink.streaming.util.KeyedTwoInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.Fixes;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

import static io.furrow.analytics.collision.Fixes.east;
import static io.furrow.analytics.collision.Fixes.of;
import static org.assertj.core.api.Assertions.assertThat;

/** At the start {@code service.devices} says that the robot carries the camera from 1000 on. */
class AssignCarriersTest {
    private static final String CAMERA = "farm|/|camera";
    private static final long DAY = 86_400_000;
    private static final long KEPT = 30 * DAY;

    @AutoClose
    private KeyedTwoInputStreamOperatorTestHarness<Device, PositionFix, DeviceChange, PositionFix> operator;

    @BeforeEach
    void start() throws Exception {
        create();
        operator.open();
    }

    @Test
    void takesTheCarrierAsOfThePositionsTime() throws Exception {
        assertThat(carrierOfCamera(999)).isEmpty();
        assertThat(carrierOfCamera(1000)).isEqualTo("farm|/|robot");
        change(0, version(1000, 1, "robot")); // the stream begins with what was read at the start
        change(1, version(2000, 2, "tractor"));
        assertThat(carrierOfCamera(1999)).isEqualTo("farm|/|robot");
        assertThat(carrierOfCamera(2000)).isEqualTo("farm|/|tractor");
        change(2, version(3000, 3, null));
        assertThat(carrierOfCamera(3000)).isEmpty();
    }

    @Test
    void letsTheGroundCarryWhatDoesNotMove() throws Exception {
        change(1, stationary("thermometer", "/"));
        change(2, stationary("station", "/north"));
        PositionFix thermometer = assigned(east("thermometer", 0, 1500));
        PositionFix station = assigned(of("farm|/north|station", "station", "m", 0, 10, 1500));

        assertThat(thermometer.sharesAggregateWith(station)).isTrue();
        assertThat(thermometer.sharesAggregateWith(assigned(east("robot", 0, 1500))))
                .isFalse();
    }

    /** Whether or not the identity names the type. */
    @Test
    void takesEntitiesOfOneIdForOneThing() {
        PositionFix tractor = of("farm|/|Tractor|e-12", "e-12", "m", 0, 10, 1500);

        assertThat(tractor.sharesAggregateWith(of("farm|/|Thermometer|e-12", "e-12", "m", 0, 10, 1500)))
                .isTrue();
        assertThat(tractor.sharesAggregateWith(of("farm|/|e-12", "e-12", "m", 0, 10, 1500)))
                .isTrue();
        assertThat(tractor.sharesAggregateWith(of("other|/|Tractor|e-12", "e-12", "m", 0, 10, 1500)))
                .isFalse();
    }

    @Test
    void leavesTheCarrierThatTheEntityNames() throws Exception {
        PositionFix named = Fixes.carriedBy("drone", east("camera", 0, 1500));
        assertThat(assigned(named)).isEqualTo(named);
    }

    @Test
    void remembersAcrossARestartAndForgetsAMonthAfterTheEnd() throws Exception {
        change(1, version(2000, 2, "tractor"));
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        create();
        operator.initializeState(snapshot);
        operator.open();
        assertThat(carrierOfCamera(2000)).isEqualTo("farm|/|tractor");

        operator.processElement2(new DeviceChange(CAMERA, 0, 2, 4000, null), 0);
        assertThat(carrierOfCamera(3999)).isEqualTo("farm|/|tractor");
        operator.processElement2(new DeviceChange("farm|/|other", 0, 3, 4000 + KEPT + 1, null), 0);
        operator.processElement2(new DeviceChange("farm|/|other", 0, 4, 4000 + KEPT + 1, null), 0);
        assertThat(operator.getOperator()
                        .getOperatorStateBackend()
                        .getBroadcastState(AssignCarriers.DEVICES)
                        .entries())
                .isEmpty();
    }

    @Test
    void knowsTheCarriersOfABacklogThoughTheMissionHasEndedMeanwhile() throws Exception {
        change(0, version(1000, 1, "robot"));
        operator.processElement2(new DeviceChange(CAMERA, 0, 1, DAY, null), 0);
        change(2, version(3 * DAY, 2, "tractor"));
        assertThat(carrierOfCamera(DAY - 1)).isEqualTo("farm|/|robot");
    }

    private void create() throws Exception {
        DeviceVersion first = version(1000, 1, "robot");
        var atStart = List.of(new TopicRecord(Topics.DEVICES, 0, 0, 0, new byte[0], first.toBytes(), Map.of()));
        operator = new KeyedTwoInputStreamOperatorTestHarness<>(
                new CoBroadcastWithKeyedOperator<>(new AssignCarriers(() -> atStart), List.of(AssignCarriers.DEVICES)),
                PositionFix::device,
                null, // what is broadcast has no key
                TypeInformation.of(Device.class));
    }

    private String carrierOfCamera(long time) throws Exception {
        return assigned(east("camera", 0, time)).carrier();
    }

    private PositionFix assigned(PositionFix fix) throws Exception {
        operator.processElement1(fix, fix.time());
        List<PositionFix> out = operator.extractOutputValues();
        return out.get(out.size() - 1);
    }

    private void change(long offset, DeviceVersion version) throws Exception {
        operator.processElement2(new DeviceChange(version.key(), 0, offset, version.from(), version), 0);
    }

    private static DeviceVersion stationary(String id, String servicePath) {
        return new DeviceVersion(id, "farm", servicePath, "", "", 1000, null, 1, null, true);
    }

    private static DeviceVersion version(long from, long sequence, String carrier) {
        return new DeviceVersion("camera", "farm", "/", "", "", from, null, sequence, carrier);
    }
}
