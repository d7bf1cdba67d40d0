package io.furrow.control.health;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;

import org.junit.jupiter.api.Test;

import io.furrow.control.manager.MapTable;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class SilenceDetectorTest {
    private static final String ID = "urn:t:1";
    private static final String KEY = "|/|" + ID;
    private static final Duration PERIOD = Duration.ofSeconds(10);

    private final MapTable<byte[]> desired = new MapTable<>(Function.identity(), Function.identity());
    private final List<Heartbeat> signs = new ArrayList<>();
    private final SilenceDetector listener = new SilenceDetector(
            HealthOptions.DEFAULT, new MonitoredDevices(desired), (key, heartbeat) -> signs.add(heartbeat));
    private long now = 1_700_000_000_000L;

    @Test
    void emitsTheFirstReportThenOneEveryHalfMinute() {
        addDesired(PERIOD);
        for (int i = 0; i <= 65; i++) {
            process(now);
            pass(1000);
        }
        assertThat(signs).hasSize(3).noneMatch(Heartbeat::silent);
    }

    /** A device may send stored reports in a burst, of which the last one is the only one for hours. */
    @Test
    void emitsTheLastReportWithinHalfAMinute() {
        addDesired(PERIOD.multipliedBy(90));
        process(5);
        process(6);
        for (int i = 0; i <= 60; i++) {
            pass(1000);
        }
        assertThat(signs).extracting(Heartbeat::reported).containsExactly(5L, 6L);
    }

    @Test
    void emitsSilenceOnceAfterThePeriodsOfADevice() {
        addDesired(PERIOD);
        process(5);
        pass(30_000);
        assertThat(signs).hasSize(1);
        pass(1);
        pass(1000);
        assertThat(signs).hasSize(2);
        assertThat(signs.get(1).silent()).isTrue();
        assertThat(signs.get(1).reported()).isEqualTo(5);
        process(6);
        assertThat(signs).hasSize(3);
        assertThat(signs.get(2).silent()).isFalse();
    }

    @Test
    void usesTheDefaultForADeviceWithoutAPeriod() {
        addDesired(null);
        process(5);
        pass(HealthOptions.DEFAULT.period().multipliedBy(3).toMillis());
        assertThat(signs).hasSize(1);
        pass(1);
        assertThat(signs).hasSize(2);
    }

    @Test
    void usesAChangedPeriod() {
        addDesired(PERIOD);
        process(5);
        addDesired(PERIOD.multipliedBy(10));
        pass(31_000);
        pass(1000);
        assertThat(signs).hasSize(1);
    }

    @Test
    void goesOnWhenTheClockIsSetBack() {
        addDesired(PERIOD);
        process(5);
        now -= 7_200_000;
        pass(0);
        pass(1000);
        assertThat(signs).as("not silent at once").hasSize(1);
        process(6);
        assertThat(signs).as("the next report is emitted").hasSize(2);
        for (int i = 0; i <= 30; i++) {
            pass(1000);
        }
        assertThat(signs.get(2).silent()).isTrue();
        desired.put(KEY, null);
        pass(5000);
        assertThat(listener.isMonitored(KEY)).isFalse();
    }

    @Test
    void detectsNoSilenceRightAfterAPause() {
        addDesired(PERIOD);
        process(5);
        pass(1000);
        pass(60_000); // as after a suspension of the process, with unread reports
        process(6);
        pass(1000);
        assertThat(signs).hasSize(2).noneMatch(Heartbeat::silent);
    }

    /** The notification of the context broker when a command is sent to a device. */
    @Test
    void ignoresARepeatedReport() {
        addDesired(PERIOD);
        process(5);
        pass(29_000);
        process(5, "off_status", "PENDING");
        pass(1001);
        assertThat(signs).hasSize(2);
        assertThat(signs.get(1).silent()).isTrue();
    }

    /** For instance a device without a clock, or a station that stamps all reports with the start of the hour. */
    @Test
    void acceptsANewValueWithTheSameTime() {
        addDesired(PERIOD);
        for (int i = 0; i < 20; i++) {
            process(5, "Time", 5, "Temperature", i);
            process(5, "Time", 5, "Temperature", i, "off_status", "SENT" + i);
            passTenSeconds();
        }
        assertThat(signs).isNotEmpty().noneMatch(Heartbeat::silent);
        assertThat(signs.get(signs.size() - 1).heard()).isGreaterThan(now - 60_000);
    }

    /** The IoT Agent stamps each report with the time of its receipt. */
    @Test
    void acceptsAReportWithTheSameValueFromADeviceWhoseClockStandsStill() {
        addDesired(PERIOD);
        for (int i = 0; i < 20; i++) {
            process(5, "Time", 5, "Temperature", 20, "TimeInstant", "2026-11-21T01:10:%02d.000Z".formatted(i));
            passTenSeconds();
        }
        assertThat(signs).isNotEmpty().noneMatch(Heartbeat::silent);
        assertThat(signs.get(signs.size() - 1).heard()).isGreaterThan(now - 60_000);
    }

    /** Also with another time: reports of a device without a clock have that of the context broker. */
    @Test
    void ignoresChangesOfCommandAttributes() {
        addDesired(PERIOD);
        process(5, "Temperature", 8);
        pass(20_000);
        process(6, "Temperature", 8, "cmd", "Stop", "cmd_status", "PENDING");
        pass(10_000);
        process(7, "Temperature", 8, "cmd", "Stop", "cmd_status", "EXPIRED");
        pass(1001);
        assertThat(signs).extracting(Heartbeat::silent).containsExactly(false, true);
        process(8, "Temperature", 8, "cmd", "Stop", "cmd_status", "EXPIRED");
        assertThat(signs).extracting(Heartbeat::silent).containsExactly(false, true, false);
    }

    /** For instance a gate that reports nothing else. */
    @Test
    void acceptsAMeasureThatIsNamedLikeTheStateOfACommand() {
        addDesired(PERIOD);
        for (int i = 0; i < 10; i++) {
            process(i, "gate_status", i % 2 == 0 ? "open" : "shut");
            passTenSeconds();
        }
        assertThat(signs).isNotEmpty().noneMatch(Heartbeat::silent);
    }

    @Test
    void detectsNoSilenceOfADeviceThatIsOff() {
        addDesired(PERIOD);
        process(5, "Status", true);
        process(6, "Status", false);
        pass(100_000);
        pass(1000);
        assertThat(signs).extracting(Heartbeat::off).containsExactly(false, true);
        process(7, "Status", true);
        pass(30_000);
        pass(1000);
        assertThat(signs).extracting(Heartbeat::silent).containsExactly(false, false, false, true);
        process(8, "Status", "Off");
        process(9, "Status", "on");
        process(10, "Status", 0);
        assertThat(signs).extracting(Heartbeat::off).endsWith(true, false, true);
    }

    /** The context broker notifies about these before the device has sent anything. */
    @Test
    void ignoresAssignedAttributes() {
        addDesired(PERIOD);
        process(5, "Mission", "m", "on_status", "PENDING", "Temperature", " ");
        assertThat(signs).isEmpty();
        process(6, "Mission", "m", "Temperature", 8);
        process(7, "on_status", "OK");
        assertThat(signs).hasSize(1);
    }

    @Test
    void emitsTheNextReportAfterARestartOfItsMission() {
        addDesired(PERIOD);
        process(5);
        addDesired(PERIOD, 9);
        pass(5_000);
        process(10);
        assertThat(signs).hasSize(2);
    }

    @Test
    void ignoresDevicesThatAreNotDesired() {
        assertThat(listener.isMonitored(KEY)).isFalse();
        addDesired(PERIOD);
        pass(5000);
        assertThat(listener.isMonitored(KEY)).isTrue();
        process(5);
        desired.put(KEY, null);
        pass(100_000);
        pass(1000);
        assertThat(signs).hasSize(1);
        assertThat(listener.isMonitored(KEY)).isFalse();
        desired.put(KEY, "[".getBytes(UTF_8));
        pass(5000);
        assertThat(listener.isMonitored(KEY)).isFalse();
    }

    @Test
    void ignoresAnEntityOfAnotherTypeOnceTheDeviceHasReported() {
        addDesired(PERIOD);
        process("Camera", 5);
        process("t", 6);
        assertThat(signs).extracting(Heartbeat::type).containsExactly("Camera", "t");

        for (int i = 0; i < 4; i++) {
            pass(10_000);
            process("Camera", 7 + i);
        }
        pass(1000);
        assertThat(signs).hasSize(3);
        assertThat(signs.get(2)).returns("t", Heartbeat::type).returns(true, Heartbeat::silent);
    }

    @Test
    void observesTheTypeThatReportsIfTheDesiredOneIsUnknown() {
        addDesired(null, PERIOD, 0);
        process("Camera", 5);
        process("T", 6);
        assertThat(signs).hasSize(1);
        pass(30_001);
        pass(1000);
        process("T", 7);
        process("Camera", 8);
        assertThat(signs).extracting(Heartbeat::type).containsExactly("Camera", "Camera", "T");
        assertThat(signs).extracting(Heartbeat::silent).containsExactly(false, true, false);
    }

    @Test
    void reportsWhetherABatteryIsInPercent() {
        addDesired(PERIOD);
        process(5, "battery", 1);
        pass(30_000);
        process(6, "battery", 2);
        pass(30_000);
        process(7, "battery", 1);
        pass(30_000);
        process(8);
        assertThat(signs).extracting(Heartbeat::percent).containsExactly(false, true, true, true);
        assertThat(signs).extracting(Heartbeat::battery).containsExactly(1.0, 0.02, 0.01, 0.01);
    }

    @Test
    void readsBatteriesAsDevicesAndRobotsReportThem() throws Exception {
        assertThat(level("battery", 0.8)).isEqualTo(0.8);
        assertThat(level("battery", 80)).isEqualTo(0.8);
        assertThat(level("battery", "{%27percentage%27: 0.8}")).isEqualTo(0.8);
        assertThat(level("battery", "80")).isEqualTo(0.8);
        assertThat(level("battery", "full")).isNull();
        assertThat(level("battery", "{}")).isNull();
        assertThat(level("battery", -1)).isNull();
        assertThat(level()).isNull();
    }

    private static Double level(Object... attributes) throws Exception {
        return Battery.levelOf(Entity.parse(entity(attributes).toBytes()));
    }

    private void process(long reported, Object... attributes) {
        assertThat(listener.isMonitored(KEY)).isTrue();
        listener.process(KEY, entity(attributes).build(), reported, now);
    }

    private void process(String type, long reported) {
        assertThat(listener.isMonitored(KEY)).isTrue();
        listener.process(KEY, Entity.builder(ID, type).build(), reported, now);
    }

    /** Builds an entity from alternating names and values. */
    private static EntityBuilder entity(Object... attributes) {
        EntityBuilder entity = Entity.builder(ID, "T");
        for (int i = 0; i < attributes.length; i += 2) {
            String name = (String) attributes[i];
            if (attributes[i + 1] instanceof Number number) {
                entity.number(name, number.doubleValue());
            } else if (attributes[i + 1] instanceof Boolean bool) {
                entity.bool(name, bool);
            } else {
                entity.text(name, (String) attributes[i + 1]);
            }
        }
        return entity;
    }

    private void pass(long millis) {
        now += millis;
        listener.passTime(now);
    }

    /** A longer step counts as a pause, after which no device is silent. */
    private void passTenSeconds() {
        for (int i = 0; i < 10; i++) {
            pass(1000);
        }
    }

    private void addDesired(Duration period) {
        addDesired(period, 0);
    }

    private void addDesired(Duration period, long from) {
        addDesired("T", period, from);
    }

    private void addDesired(String type, Duration period, long from) {
        DeviceVersion version = new DeviceVersion(ID, "", "/", "d", "m", from, null, 1, null);
        DesiredDevice device = DesiredDevice.simulated(
                version,
                type,
                type == null ? null : ID,
                true,
                period,
                NgsiJson.mapper().createObjectNode());
        desired.put(KEY, device.toBytes());
    }
}
