package io.furrow.simulators.desired;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.SplittableRandom;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.simulators.desired.DeviceReconciler.Step;

import static org.assertj.core.api.Assertions.assertThat;

class DeviceReconcilerTest {
    private static final String KEY = "farm|/|urn:1";

    private final DeviceReconciler reconciler = new DeviceReconciler();

    @Test
    void startsWhatIsDesiredAndStopsWhatIsNotAnyMore() {
        DesiredDevice first = desired(1, true, 18);
        DesiredDevice second = desired(2, false, 18);

        Step start = reconciler.take(KEY, first).orElseThrow();
        assertThat(start).isEqualTo(new Step.Start(KEY, first));
        assertThat(reconciler.done(start, null)).contains(status(1, DeviceStatus.State.RUNNING));
        assertThat(reconciler.running()).isEqualTo(1);

        Step stop = reconciler.take(KEY, second).orElseThrow();
        assertThat(stop).isEqualTo(new Step.Stop(KEY, first));
        assertThat(reconciler.done(stop, null)).contains(status(2, DeviceStatus.State.STOPPED));
        assertThat(reconciler.running()).isZero();
    }

    @Test
    void passesOverWhatIsOutOfDateOrThereTwice() {
        reconciler.done(reconciler.take(KEY, desired(5, true, 18)).orElseThrow(), null);

        assertThat(reconciler.take(KEY, desired(5, true, 18))).isEmpty();
        assertThat(reconciler.take(KEY, desired(4, false, 18))).isEmpty();
        assertThat(reconciler.running()).isEqualTo(1);
    }

    @Test
    void replacesADeviceThatIsDesiredOtherwiseAndOnlyConfirmsOneThatIsNot() {
        DesiredDevice first = desired(1, true, 18);
        DesiredDevice other = desired(3, true, 25);
        reconciler.done(reconciler.take(KEY, first).orElseThrow(), null);

        Step same = reconciler.take(KEY, desired(2, true, 18)).orElseThrow();
        assertThat(same).isEqualTo(new Step.Confirm(KEY));
        assertThat(reconciler.done(same, null)).contains(status(2, DeviceStatus.State.RUNNING));

        Step replace = reconciler.take(KEY, other).orElseThrow();
        assertThat(replace).isEqualTo(new Step.Replace(KEY, desired(2, true, 18), other));
        assertThat(reconciler.done(replace, null)).contains(status(3, DeviceStatus.State.RUNNING));
    }

    @Test
    void replacesADeviceThatHasNewCredentials() {
        DesiredDevice first = desired(1, true, 18);
        DesiredDevice rotated = desired(2, true, 18).withGeneration(1);
        reconciler.done(reconciler.take(KEY, first).orElseThrow(), null);

        assertThat(reconciler.take(KEY, rotated)).contains(new Step.Replace(KEY, first, rotated));
    }

    @Test
    void reportsWhyADeviceFailedAndTriesAnewWithTheNextSequence() {
        Step start = reconciler.take(KEY, desired(1, true, 18)).orElseThrow();
        assertThat(reconciler.done(start, "there is no field 'x'"))
                .contains(new DeviceStatus(1, DeviceStatus.State.FAILED, "there is no field 'x'"));
        assertThat(reconciler.running()).isZero();

        assertThat(reconciler.take(KEY, desired(2, true, 18)).orElseThrow()).isInstanceOf(Step.Start.class);
    }

    @Test
    void stopsAndForgetsADeviceThatIsDeleted() {
        DesiredDevice first = desired(1, true, 18);
        reconciler.done(reconciler.take(KEY, first).orElseThrow(), null);

        Step stop = reconciler.take(KEY, null).orElseThrow();
        assertThat(stop).isEqualTo(new Step.Stop(KEY, first));
        assertThat(reconciler.done(stop, null)).isEmpty();
        assertThat(reconciler.take(KEY, null)).isEmpty();
        assertThat(reconciler.take(KEY, desired(1, true, 18)).orElseThrow()).isInstanceOf(Step.Start.class);
    }

    @Test
    void leavesDevicesAloneThatReportByThemselves() {
        var alone = DesiredDevice.simulated(version(1), null, null, true, null, JsonNodeFactory.instance.objectNode());

        assertThat(reconciler.take(KEY, alone)).isEmpty();
        assertThat(reconciler.running()).isZero();
    }

    /** However often and late records come again, in the end the newest of each device holds, and its status says so. */
    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
    void endsWithTheNewestOfEachDevice(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        List<DesiredDevice> records = new ArrayList<>();
        Map<String, DesiredDevice> runs = new HashMap<>();
        Map<String, DeviceStatus> statuses = new HashMap<>();
        Map<String, DesiredDevice> newest = new HashMap<>();
        for (int i = 1; i <= 300; i++) {
            boolean again = !records.isEmpty() && random.nextInt(3) == 0;
            DesiredDevice record = again
                    ? records.get(random.nextInt(records.size()))
                    : desired("urn:" + random.nextInt(10), i, random.nextBoolean(), random.nextInt(3));
            records.add(record);
            String key = record.version().key();
            newest.merge(
                    key, record, (a, b) -> a.version().sequence() >= b.version().sequence() ? a : b);
            Optional<Step> step = reconciler.take(key, record);
            step.ifPresent(requested -> {
                perform(requested, runs);
                reconciler.done(requested, null).ifPresent(status -> statuses.put(key, status));
            });
        }

        newest.forEach((key, record) -> {
            assertThat(statuses.get(key))
                    .isEqualTo(status(
                            record.version().sequence(),
                            record.running() ? DeviceStatus.State.RUNNING : DeviceStatus.State.STOPPED));
            assertThat(runs.containsKey(key)).isEqualTo(record.running());
            if (record.running()) {
                assertThat(runs.get(key).settings()).isEqualTo(record.settings());
            }
        });
        assertThat(reconciler.running()).isEqualTo(runs.size());
    }

    /** As a host does, which never starts what runs nor stops what does not. */
    private static void perform(Step step, Map<String, DesiredDevice> runs) {
        if (step instanceof Step.Start start) {
            assertThat(runs.put(start.key(), start.device())).isNull();
        } else if (step instanceof Step.Replace replace) {
            assertThat(runs.put(replace.key(), replace.device())).isNotNull();
        } else if (step instanceof Step.Stop stop) {
            assertThat(runs.remove(stop.key())).isNotNull();
        }
    }

    private static DeviceStatus status(long sequence, DeviceStatus.State state) {
        return new DeviceStatus(sequence, state, null);
    }

    private static DesiredDevice desired(long sequence, boolean running, int celsius) {
        return desired("urn:1", sequence, running, celsius);
    }

    private static DesiredDevice desired(String id, long sequence, boolean running, int celsius) {
        var version = new DeviceVersion(id, "farm", "/", "farm", "weeding", 1000 + sequence, null, sequence, null);
        return DesiredDevice.simulated(
                version,
                "Thermometer",
                id,
                running,
                Duration.ofSeconds(1),
                JsonNodeFactory.instance.objectNode().put("meanCelsius", celsius));
    }

    private static DeviceVersion version(long sequence) {
        return new DeviceVersion("urn:1", "farm", "/", "farm", "weeding", 0, null, sequence, null);
    }
}
