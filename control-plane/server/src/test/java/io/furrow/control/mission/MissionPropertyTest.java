package io.furrow.control.mission;

import java.time.Duration;
import java.time.Instant;
import java.util.EnumSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Test;

import io.furrow.control.manager.CapturingPublisher;
import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Applies random commands, reports of hosts and passing time; after each step the farm is consistent. */
class MissionPropertyTest {
    private static final int FARMS = 60;
    private static final int STEPS = 150;
    private static final List<String> NAMES = List.of("a", "b", "c", "d");
    private static final List<String> DOMAINS = List.of("north", "south");

    @Test
    void staysConsistentUnderRandomEvents() throws Exception {
        long seed = Long.getLong("furrow.mission.seed", System.nanoTime());
        int rejected = 0;
        for (int i = 0; i < FARMS; i++) {
            rejected += new Walk(new Random(seed + i), "seed " + seed + " farm " + i).run();
        }
        assertThat(rejected).isBetween(FARMS, FARMS * STEPS);
    }

    /** A farm with random events. */
    private static final class Walk {
        private final FarmFixture farm;
        private final Random random;
        private final String label;
        private int rejected;

        Walk(Random random, String label) {
            this.random = random;
            this.label = label;
            this.farm = new FarmFixture(1 + random.nextInt(4));
        }

        int run() throws Exception {
            for (int i = 0; i < STEPS; i++) {
                Map<String, MissionStatus> before = statuses();
                step();
                checkStates(before);
                checkDevices();
                checkTopics();
            }
            checkEverythingSettles();
            checkSequences();
            return rejected;
        }

        private void step() {
            String content = farm.content();
            int written = farm.publisher.all().size();
            try {
                switch (random.nextInt(10)) {
                    case 0 -> farm.request(domainCommand());
                    case 1, 2, 3 -> farm.request(missionCommand());
                    case 4 -> farm.pass(random.nextInt(40_000));
                    case 5 -> farm.hostAll();
                    case 6, 7 -> farm.step();
                    default -> reportOne();
                }
            } catch (RejectedException e) {
                rejected++;
                assertThat(farm.content()).as(label + ": " + e.getMessage()).isEqualTo(content);
                assertThat(farm.publisher.all()).as(label).hasSize(written);
            }
        }

        private DomainCommand domainCommand() {
            String domain = pick(DOMAINS);
            return switch (random.nextInt(5)) {
                case 0 -> new DomainCommand.Delete(domain, random.nextBoolean());
                case 1 -> new DomainCommand.Change(domain, new DomainDetails("N" + farm.now, null, null, null));
                default -> new DomainCommand.Create(domain, DomainDetails.NONE);
            };
        }

        private MissionCommand missionCommand() {
            String mission = pick(NAMES);
            return switch (random.nextInt(7)) {
                case 6 -> new MissionCommand.AddDevices(mission, added());
                case 0 -> new MissionCommand.Create(mission, pick(DOMAINS), plan());
                case 1 -> new MissionCommand.Delete(mission);
                case 2 -> new MissionCommand.Stop(mission);
                default ->
                    new MissionCommand.Start(
                            mission,
                            random.nextInt(3) == 0 ? null : pick(DOMAINS),
                            plan(),
                            random.nextInt(4) == 0 ? Instant.ofEpochMilli(farm.now + random.nextInt(50_000)) : null,
                            random.nextInt(3) == 0 ? Duration.ofMillis(1 + random.nextInt(200_000)) : null);
            };
        }

        private MissionPlan plan() {
            return switch (random.nextInt(4)) {
                case 0 -> new MissionPlan.FromTemplate(random.nextInt(3) == 0 ? "nosuch" : TemplateStore.DEMO, 0);
                case 1 -> new MissionPlan.Unspecified();
                case 2 ->
                    FarmFixture.devices(
                            FarmFixture.group("Camera", 1 + random.nextInt(3)), DeviceGroup.entity("urn:robot"));
                default ->
                    FarmFixture.devices(
                            FarmFixture.group("Thermometer", 1 + random.nextInt(4)), FarmFixture.real("Camera", 2));
            };
        }

        private MissionDevices added() {
            return new MissionDevices(
                    random.nextBoolean()
                            ? List.of(DeviceGroup.entity("urn:robot"))
                            : List.of(FarmFixture.group("Camera", 1 + random.nextInt(3))));
        }

        private void reportOne() {
            List<DeviceState> all = farm.all(farm.devices);
            if (!all.isEmpty()) {
                DesiredDevice device = all.get(random.nextInt(all.size())).device();
                if (device.simulated() || random.nextInt(4) == 0) {
                    farm.report(device, State.values()[random.nextInt(3)]);
                } else {
                    farm.report(device, farm.now - random.nextInt(2) * 1_000_000L);
                }
            }
        }

        private Map<String, MissionStatus> statuses() {
            Map<String, MissionStatus> statuses = new HashMap<>();
            farm.all(farm.statuses).forEach(status -> statuses.put(status.mission(), status));
            return statuses;
        }

        /** Missions follow the life cycle, possibly several states per step; one whose devices are all confirmed has proceeded. */
        private void checkStates(Map<String, MissionStatus> before) {
            for (MissionStatus status : farm.all(farm.statuses)) {
                MissionStatus last = before.get(status.mission());
                MissionState from = last == null ? MissionState.CREATED : last.state();
                assertThat(reachable(from)).as(label + " " + status).contains(status.state());
                if (status.state() == MissionState.STARTING || status.state() == MissionState.STOPPING) {
                    assertThat(status.confirmed()).as(label).isLessThan(status.devices());
                    assertThat(status.due() != null || !status.missing().isEmpty())
                            .as(label)
                            .isTrue();
                }
                assertThat(status.confirmed()).as(label + " " + status).isBetween(0, status.devices());
                boolean up = status.state() == MissionState.STARTING || status.state() == MissionState.RUNNING;
                assertThat(status.reason() != null)
                        .as(label)
                        .isEqualTo(status.state() == MissionState.FAILED
                                || up && !status.missing().isEmpty());
                assertThat(status.sequence())
                        .as(label)
                        .isEqualTo(farm.missions.get(status.mission()).sequence());
            }
            assertThat(before.values().stream().filter(status -> farm.status(status.mission()) == null))
                    .as("deleted while active in an existing domain, " + label)
                    .noneMatch(status -> status.state().isActive() && farm.domains.contains(status.domain()));
            assertThat(farm.all(farm.statuses)).as(label).allMatch(status -> farm.domains.contains(status.domain()));
        }

        private static Set<MissionState> reachable(MissionState from) {
            Set<MissionState> reached = EnumSet.of(from);
            for (int i = 0; i < 2; i++) {
                for (MissionState one : Set.copyOf(reached)) {
                    for (MissionState next : MissionState.values()) {
                        if (one.canBecome(next)) {
                            reached.add(next);
                        }
                    }
                }
            }
            return reached;
        }

        /** Once all devices are written, starting or running missions have exactly their devices, others none. The counts are correct. */
        private void checkDevices() {
            Map<String, Integer> running = new HashMap<>();
            Map<String, Integer> confirmed = new HashMap<>();
            for (DeviceState each : farm.all(farm.devices)) {
                running.merge(each.mission(), each.device().running() ? 1 : 0, Integer::sum);
                boolean counts = each.confirmed();
                MissionStatus status = farm.status(each.mission());
                boolean ofNow = status != null && each.device().version().sequence() > status.sequence();
                confirmed.merge(each.mission(), counts && ofNow ? 1 : 0, Integer::sum);
                assertThat(farm.status(each.mission())).as(label).isNotNull();
            }
            for (MissionStatus status : farm.all(farm.statuses)) {
                boolean has = status.state() == MissionState.STARTING || status.state() == MissionState.RUNNING;
                Mission mission = farm.missions.get(status.mission());
                assertThat(mission.running() || !has).as(label).isTrue();
                if (farm.rollouts.get(status.mission()) == null) {
                    assertThat(running.getOrDefault(status.mission(), 0))
                            .as(label + " " + status)
                            .isEqualTo(has ? mission.deviceCount() : 0);
                }
                if (status.state().isActive()) {
                    assertThat(status.confirmed()).as(label).isEqualTo(confirmed.getOrDefault(status.mission(), 0));
                }
            }
        }

        /** The topics match the stores of the managers. */
        private void checkTopics() throws Exception {
            assertThat(texts(Topics.MISSIONS)).as(label).isEqualTo(states(farm.all(farm.missions), Mission::mission));
            assertThat(texts(Topics.MISSIONS_STATUS))
                    .as(label)
                    .isEqualTo(states(farm.all(farm.statuses), MissionStatus::mission));
            assertThat(texts(Topics.DOMAINS))
                    .as(label)
                    .isEqualTo(states(farm.all(farm.domains), domain -> domain.domain()));
            Map<String, byte[]> devices = farm.publisher.compacted(Topics.DEVICES);
            assertThat(devices).as(label).hasSameSizeAs(farm.all(farm.devices));
            for (DeviceState each : farm.all(farm.devices)) {
                byte[] value = devices.get(each.device().version().key());
                assertThat(DesiredDevice.read(value)).as(label).isEqualTo(each.device());
                DeviceVersion version = DeviceVersion.read(value);
                assertThat(version.until() == null)
                        .as(label)
                        .isEqualTo(each.device().running());
            }
        }

        private Map<String, String> texts(String topic) {
            Map<String, String> texts = new HashMap<>();
            farm.publisher.compacted(topic).forEach((key, value) -> texts.put(key, new String(value)));
            return texts;
        }

        private static <T> Map<String, String> states(List<T> all, java.util.function.Function<T, String> name) {
            Map<String, String> states = new HashMap<>();
            all.forEach(each -> states.put(name.apply(each), FarmFixture.json(each)));
            return states;
        }

        /** A scheduled mission starts in the first round and may end in the second. */
        private void checkEverythingSettles() {
            for (int round = 0; round < 3; round++) {
                farm.pass(300_000);
                writeAll();
                farm.hostAll();
            }
            assertThat(farm.all(farm.statuses))
                    .as(label)
                    .extracting(MissionStatus::state)
                    .doesNotContain(MissionState.STARTING, MissionState.STOPPING);
        }

        private void writeAll() {
            for (int i = 0; farm.step(); i++) {
                assertThat(i).as(label).isLessThan(100);
            }
        }

        private void checkSequences() throws Exception {
            long last = 0;
            for (CapturingPublisher.Written record : farm.publisher.all()) {
                if (record.topic().equals(Topics.DEVICES) && record.value() != null) {
                    long sequence = DeviceVersion.read(record.value()).sequence();
                    assertThat(sequence).as(label).isGreaterThan(last);
                    last = sequence;
                }
            }
        }

        private <T> T pick(List<T> all) {
            return all.get(random.nextInt(all.size()));
        }
    }
}
