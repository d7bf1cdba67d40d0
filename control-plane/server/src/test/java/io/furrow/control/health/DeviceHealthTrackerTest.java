package io.furrow.control.health;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;

import org.junit.jupiter.api.Test;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmHandlerFixture;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.CapturingPublisher;
import io.furrow.control.manager.MapTable;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class DeviceHealthTrackerTest {
    private static final String ID = "urn:t:1";
    private static final String KEY = "|/|" + ID;
    private static final String OVER = "its devices report again or were stopped";
    private static final long START = 1_700_000_000_000L;
    /** Three periods plus the timeout. */
    private static final long LONG_ENOUGH = 30_000 + DeviceHealthTracker.TIMEOUT.toMillis();

    private final MapTable<byte[]> desired = new MapTable<>(Function.identity(), Function.identity());
    private final MapTable<DeviceHealth> health = MapTable.of(DeviceHealth.class);
    private final CapturingPublisher publisher = new CapturingPublisher();
    private final AlarmCommandHandler alarms = AlarmHandlerFixture.writingTo(publisher);
    private DeviceConnection connection;
    private DeviceHealthTracker tracker = tracker();

    @Test
    void raisesAnAlarmForADeviceThatNeverReported() {
        addDesired("m", START);
        tracker.passTime(START);
        assertThat(existing().silent()).isFalse();
        tracker.passTime(START + LONG_ENOUGH);
        assertThat(existing().silent()).isFalse();
        tracker.passTime(START + LONG_ENOUGH + 10_000);
        assertThat(existing().silent()).isTrue();
        assertThat(alarms())
                .extracting(alarm -> alarm.description().text())
                .containsExactly("1 of 1 device of mission m is silent: " + ID);
    }

    /** The count in the text is not updated, because the alarm would be delivered again and again. */
    @Test
    void reportsWhyADeviceIsSilent() {
        addDesired("m", START);
        connection = refusedConnection(12);
        tracker.passTime(START);
        tracker.passTime(START + LONG_ENOUGH + 10_000);
        connection = refusedConnection(13);
        tracker.passTime(START + LONG_ENOUGH + 30_000);

        assertThat(alarms())
                .extracting(alarm -> alarm.description().text())
                .containsExactly("1 of 1 device of mission m is silent: " + ID
                        + " (its password was refused 12 times, last at 2023-11-14T22:13:21Z)");

        connection = new DeviceConnection(START, null, null, null, null, false);
        tracker.passTime(START + LONG_ENOUGH + 50_000);
        assertThat(alarms())
                .extracting(alarm -> alarm.description().text())
                .allMatch(text -> text.endsWith("(the IoT Agent does not know it)"));
    }

    private static DeviceConnection refusedConnection(long count) {
        var refused = new RefusedLogin(count, START + 1000, DeviceConnection.WRONG_PASSWORD, "furrow.d.m.d.1.0");
        return new DeviceConnection(START, null, refused, null, null, true);
    }

    @Test
    void endsTheAlarmAtTheFirstHeartbeat() {
        addDesired("m", START);
        tracker.passTime(START);
        tracker.passTime(START + LONG_ENOUGH + 10_000);
        tracker.take(KEY, heartbeat(false, START + LONG_ENOUGH + 11_000), START + LONG_ENOUGH + 11_000);
        tracker.passTime(START + LONG_ENOUGH + 11_000);
        assertThat(existing())
                .returns(false, DeviceHealth::silent)
                .returns(77L, health -> health.report().lastSeen())
                .returns(START + LONG_ENOUGH + 11_000, DeviceHealth::since);
        assertThat(alarms()).extracting(alarm -> alarm.handling().reason()).containsExactly(OVER);
    }

    @Test
    void detectsSilenceAfterTheDetectorDied() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(false, START), START);
        tracker.passTime(START + 10_000);
        tracker.passTime(START + 10_000 + LONG_ENOUGH);
        assertThat(existing().silent()).isFalse();
        tracker.passTime(START + 20_000 + LONG_ENOUGH);
        assertThat(existing().silent()).isTrue();
    }

    @Test
    void detectsSilenceWithinItsTimeWhenTheClockIsSetBack() {
        addDesired("m", START + 7_200_000);
        tracker.passTime(START + 7_200_000);
        tracker.take(KEY, heartbeat(false, START + 7_200_000), START + 7_200_000);
        tracker.passTime(START);
        assertThat(existing().silent()).isFalse();
        tracker.passTime(START + LONG_ENOUGH + 10_000);
        assertThat(existing().silent()).isTrue();
        assertThat(alarms()).isNotEmpty();
    }

    /** The instance that watched before had a clock that is two hours ahead. */
    @Test
    void detectsSilenceAndReportsThoughAnotherClockWasAhead() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(false, START + 7_200_000), START);
        tracker.passTime(START);
        tracker.passTime(START + LONG_ENOUGH + 10_000);
        assertThat(existing().silent()).isTrue();

        tracker.take(KEY, heartbeat(false, START + LONG_ENOUGH + 11_000), START + LONG_ENOUGH + 11_000);
        assertThat(existing().silent()).isFalse();
    }

    @Test
    void detectsNoSilenceForTheTimeOfAnOutage() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(false, START), START);
        tracker = tracker(); // while the control plane was unavailable for a day
        long back = START + Duration.ofDays(1).toMillis();
        tracker.passTime(back);
        tracker.passTime(back + LONG_ENOUGH);
        assertThat(existing().silent()).isFalse();
    }

    @Test
    void ignoresASilenceOlderThanAReport() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(false, START + 5), START + 5);
        tracker.take(KEY, heartbeat(true, START), START + 31_000);
        assertThat(existing().silent()).isFalse();
        tracker.take(KEY, heartbeat(true, START + 5), START + 31_000);
        assertThat(existing().silent()).isTrue();
        tracker.passTime(START + 31_000);
        assertThat(alarms()).extracting(alarm -> alarm.extent().affected()).containsExactly(1);
    }

    @Test
    void removesADeviceThatIsNoLongerDesiredAndEndsItsAlarm() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(true, START), START);
        tracker.passTime(START);
        assertThat(alarms()).hasSize(1);
        desired.put(KEY, null);
        tracker.take(KEY, heartbeat(false, START + 1), START + 1);
        tracker.passTime(START + 20_000);
        assertThat(publisher.compacted(Topics.DEVICES_HEALTH)).isEmpty();
        assertThat(health.all()).isEmpty();
        assertThat(alarms()).extracting(alarm -> alarm.handling().reason()).containsExactly(OVER);
    }

    @Test
    void closesAlarmsWithoutACause() {
        Cause single = new Cause(AlarmKind.SILENT_DEVICE, ID, "x", List.of(), null);
        alarms.raise(single, START);
        addDesired("m", START);
        tracker.passTime(START);
        assertThat(alarms()).extracting(alarm -> alarm.handling().reason()).containsExactly(OVER);
    }

    @Test
    void writesNothingWithoutChanges() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(false, START), START);
        int written = publisher.all().size();
        tracker.passTime(START + 10_000);
        tracker.passTime(START + 20_000);
        assertThat(publisher.all()).hasSize(written);
        addDesired("other", START);
        tracker.passTime(START + 30_000);
        assertThat(existing().device().mission()).isEqualTo("other");
    }

    /** After a restart the detector takes 1 for a whole, until the device reports more. */
    @Test
    void remembersThatADeviceReportsPercent() {
        addDesired("m", START);
        tracker.take(KEY, battery(0.02, true, START), START);
        tracker.take(KEY, battery(1, false, START + 1), START + 1);
        assertThat(existing().report())
                .returns(0.01, DeviceHealth.NewestReport::battery)
                .returns(true, DeviceHealth.NewestReport::percent);
        tracker.take(KEY, battery(1, null, START + 2), START + 2);
        assertThat(existing().report().battery()).as("with a unit").isEqualTo(1);
        tracker.take(KEY, heartbeat(false, START + 3), START + 3);
        assertThat(existing().report().percent()).isTrue();
    }

    /** After a start the detector does not know yet which of two entities with one id the device is. */
    @Test
    void keepsTheDesiredTypeUntilItIsSilent() {
        addDesired("m", START);
        tracker.take(KEY, heartbeat(false, START), START);
        Heartbeat other = new Heartbeat(ID, "Other", false, START + 1, 77, null, null, null, false);

        tracker.take(KEY, other, START + 1);
        assertThat(existing().device().type()).isEqualTo("T");
        tracker.take(KEY, heartbeat(true, START + 2), START + 2);
        tracker.take(KEY, new Heartbeat(ID, "Other", false, START + 3, 77, null, 0.05, false, false), START + 3);
        assertThat(existing().device().type()).isEqualTo("Other");

        tracker.take(KEY, heartbeat(false, START + 4), START + 4);
        assertThat(existing())
                .returns("T", health -> health.device().type())
                .returns(null, health -> health.report().battery());
    }

    private static Heartbeat battery(double battery, Boolean percent, long heard) {
        return new Heartbeat(ID, "T", false, heard, 77, null, battery, percent, false);
    }

    private DeviceHealthTracker tracker() {
        return new DeviceHealthTracker(
                health,
                new MonitoredDevices(desired),
                HealthOptions.DEFAULT,
                new SilenceAlarmReconciler(HealthOptions.DEFAULT, alarms, key -> Optional.ofNullable(connection)),
                publisher);
    }

    private DeviceHealth existing() {
        return StateJson.read(publisher.compacted(Topics.DEVICES_HEALTH).get(KEY), DeviceHealth.class);
    }

    private List<Alarm> alarms() {
        List<Alarm> all = new ArrayList<>();
        publisher.compacted(Topics.ALARMS).values().forEach(json -> all.add(StateJson.read(json, Alarm.class)));
        return all;
    }

    private static Heartbeat heartbeat(boolean silent, long heard) {
        return new Heartbeat(ID, "T", silent, heard, 77, null, null, null, false);
    }

    private void addDesired(String mission, long from) {
        DeviceVersion version = new DeviceVersion(ID, "", "/", "d", mission, from, null, 1, null);
        DesiredDevice device = DesiredDevice.simulated(
                version,
                "T",
                ID,
                true,
                Duration.ofSeconds(10),
                NgsiJson.mapper().createObjectNode());
        desired.put(KEY, device.toBytes());
    }
}
