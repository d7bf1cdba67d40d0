package io.furrow.control.health;

import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Function;
import java.util.stream.Collectors;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInfo;
import org.junit.jupiter.api.TestReporter;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmHandlerFixture;
import io.furrow.control.alarm.AlarmState;
import io.furrow.control.manager.CapturingPublisher;
import io.furrow.control.manager.MapTable;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;

/** Applies random silences, recoveries, closings, mutes, stops and restarts; after each the alarms finally match the causes. */
@Tag("full")
class SilencePropertyTest {
    private static final int FARMS = 20;
    private static final int STEPS = 50;
    private static final Duration PERIOD = Duration.ofSeconds(10);

    @Test
    void raisesAlarmsOnlyForSilentDevices(TestInfo test, TestReporter reporter) {
        long seed = System.nanoTime();
        reporter.publishEntry(test.getDisplayName(), "seed " + seed);
        Map<AlarmKind, Integer> raised = new TreeMap<>();
        int rejected = 0;
        for (int i = 0; i < FARMS; i++) {
            Walk walk = new Walk(new Random(seed + i), "seed " + (seed + i) + " ");
            walk.run();
            rejected += walk.rejected;
            walk.raised.forEach((kind, number) -> raised.merge(kind, number, Integer::sum));
        }
        assertThat(raised).containsOnlyKeys(AlarmKind.SILENT_DEVICE, AlarmKind.SILENT_MISSION, AlarmKind.SILENT_FARM);
        assertThat(rejected).as("an active cause cannot be closed manually").isPositive();
    }

    private static final class Walk {
        private final MapTable<byte[]> desired = new MapTable<>(Function.identity(), Function.identity());
        private final MapTable<DeviceHealth> health = MapTable.of(DeviceHealth.class);
        private final CapturingPublisher publisher = new CapturingPublisher();
        private final AlarmCommandHandler alarms = AlarmHandlerFixture.writingTo(publisher);
        private final Set<String> reporting = new HashSet<>();
        private final Map<AlarmKind, Integer> raised = new TreeMap<>();
        private final Random random;
        private final String label;
        private DeviceHealthTracker tracker = tracker();
        private long now = 1_700_000_000_000L;
        private int rejected;

        Walk(Random random, String label) {
            this.random = random;
            this.label = label;
        }

        void run() {
            for (int i = 0; i < 30; i++) {
                addDesired(i, "m" + i % 3);
                reporting.add(key(i));
            }
            for (int i = 0; i < STEPS; i++) {
                step();
                settle();
                check();
            }
        }

        private void step() {
            switch (random.nextInt(9)) {
                case 0, 1 -> reporting.remove(key(random.nextInt(30)));
                case 2 -> reporting.add(key(random.nextInt(30)));
                case 3 -> reporting.removeIf(key -> random.nextInt(4) > 0);
                case 4 ->
                    desired.all().forEach(each -> reporting.add(version(each).key()));
                case 5 -> reporting.clear();
                case 6 -> request();
                case 7 -> {
                    int device = random.nextInt(30);
                    if (random.nextBoolean()) {
                        desired.put(key(device), null);
                    } else {
                        addDesired(device, "m" + random.nextInt(3));
                    }
                }
                default -> tracker = tracker();
            }
        }

        private void request() {
            List<Alarm> open = open();
            try {
                if (open.isEmpty() || random.nextBoolean()) {
                    String device = "urn:" + random.nextInt(30);
                    AlarmCommand.Target target = new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, device);
                    alarms.answer(
                            random.nextBoolean()
                                    ? new AlarmCommand.Mute(target, Duration.ofMinutes(1 + random.nextInt(20)))
                                    : new AlarmCommand.Unmute(target),
                            now);
                    return;
                }
                Alarm one = open.get(random.nextInt(open.size()));
                alarms.answer(new AlarmCommand.Close(one.alarm(), "ann"), now);
            } catch (RejectedException e) {
                rejected++;
            }
        }

        /** Five minutes: longer than the detection of any silence and the end of a farm alarm take. */
        private void settle() {
            for (int second = 0; second < 300; second += 5) {
                now += 5000;
                if (second % 10 == 0) {
                    reporting.forEach(key -> tracker.take(
                            key, new Heartbeat(id(key), "T", false, now, now, null, null, null, false), now));
                    if (!reporting.isEmpty()) {
                        tracker.take(Heartbeat.PULSE_KEY, Heartbeat.pulse(now), now);
                    }
                }
                tracker.passTime(now);
                alarms.passTime(now);
            }
        }

        private void check() {
            List<Alarm> open = open();
            open.forEach(alarm -> raised.merge(alarm.kind(), 1, Integer::sum));
            assertThat(open)
                    .as(label)
                    .extracting(alarm -> alarm.kind() + alarm.subject())
                    .doesNotHaveDuplicates();
            Map<String, Long> silent = health.all().stream()
                    .filter(device -> device.silent()
                            && !alarms.isMuted(
                                    AlarmKind.SILENT_DEVICE, device.device().id(), now))
                    .collect(Collectors.groupingBy(
                            device -> "urn:ngsi-ld:Mission:" + device.device().mission(), Collectors.counting()));
            Map<String, Long> counted = open.stream()
                    .filter(alarm -> alarm.kind() == AlarmKind.SILENT_DEVICE)
                    .collect(Collectors.toMap(
                            Alarm::subject, alarm -> (long) alarm.extent().affected()));
            assertThat(counted)
                    .as(label + "every cause has an alarm, none is without")
                    .isEqualTo(silent);
            Set<String> ids = open.stream().map(Alarm::alarm).collect(Collectors.toSet());
            for (Alarm alarm : open) {
                if (alarm.inhibitedBy() != null) {
                    assertThat(ids).as(label).contains(alarm.inhibitedBy());
                }
                if (alarm.kind() != AlarmKind.SILENT_DEVICE) {
                    assertThat(alarm.extent().affected() * 4)
                            .as(label + alarm)
                            .isGreaterThanOrEqualTo(alarm.extent().total());
                }
            }
            boolean nothing = reporting.isEmpty()
                    && silent.values().stream().mapToLong(each -> each).sum() >= 3
                    && 2 * silent.values().stream().mapToLong(each -> each).sum()
                            >= health.all().size();
            if (nothing) {
                assertThat(open)
                        .as(label)
                        .filteredOn(alarm -> alarm.inhibitedBy() == null)
                        .extracting(Alarm::kind)
                        .containsExactly(AlarmKind.SILENT_FARM);
            } else if (!reporting.isEmpty()) {
                assertThat(open).as(label).extracting(Alarm::kind).doesNotContain(AlarmKind.SILENT_FARM);
            }
        }

        private List<Alarm> open() {
            return publisher.compacted(Topics.ALARMS).values().stream()
                    .map(json -> StateJson.read(json, Alarm.class))
                    .filter(alarm -> alarm.state() != AlarmState.CLOSED)
                    .toList();
        }

        private DeviceHealthTracker tracker() {
            return new DeviceHealthTracker(
                    health,
                    new MonitoredDevices(desired),
                    HealthOptions.DEFAULT,
                    new SilenceAlarmReconciler(HealthOptions.DEFAULT, alarms, key -> Optional.empty()),
                    publisher);
        }

        private static String key(int number) {
            return "|/|urn:" + number;
        }

        private static String id(String key) {
            return key.substring(3);
        }

        private static DeviceVersion version(byte[] value) {
            return Unchecked.get(() -> DeviceVersion.read(value));
        }

        private void addDesired(int number, String mission) {
            DeviceVersion version = new DeviceVersion("urn:" + number, "", "/", "d", mission, now, null, 1, null);
            desired.put(
                    key(number),
                    DesiredDevice.simulated(
                                    version,
                                    "T",
                                    "t",
                                    true,
                                    PERIOD,
                                    NgsiJson.mapper().createObjectNode())
                            .toBytes());
        }
    }
}
