package io.furrow.simulators.host;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.SplittableRandom;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.GroupRef;
import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.simulators.fleet.FarmFleet;
import io.furrow.simulators.robot.WorkField;

import static org.assertj.core.api.Assertions.assertThat;

class FleetReconcilerTest {
    private static final String FIELD = """
            {"type": "Feature", "id": "orchard", "properties": {}, "geometry": {"type": "Polygon",
             "coordinates": [[[-3.5, 40.3], [-3.49, 40.3], [-3.49, 40.31], [-3.5, 40.3]]]}}
            """;

    private final Set<String> running = new TreeSet<>();
    private final Map<String, DeviceStatus> statuses = new HashMap<>();
    private final StatusPublisher statusPublisher = new StatusPublisher((key, status) -> statuses.put(key, status));
    private final Fleet fleet = new Fleet();
    private final FleetReconciler reconciler = new FleetReconciler(fleet::add, fleet::remove, statusPublisher, 0);

    /** Records which devices should run. */
    private final class Fleet {
        void add(Collection<FarmFleet.Member> members) {
            members.forEach(member -> {
                assertThat(running.add(member.device().id())).isTrue();
            });
        }

        void remove(String device) {
            assertThat(running.remove(device)).isTrue();
        }
    }

    @Test
    void startsReplacesAndStops() {
        take("t-1", desired("t-1", 1, true, path(-3.5)));
        statusPublisher.up("t-1");
        take("t-1", desired("t-1", 2, true, path(-3.4)));
        assertThat(running).containsExactly("t-1");
        assertThat(statuses).containsEntry("t-1", status(1, State.RUNNING));

        statusPublisher.up("t-1");
        assertThat(statuses).containsEntry("t-1", status(2, State.RUNNING));

        take("t-1", desired("t-1", 3, false, path(-3.4)));
        assertThat(running).isEmpty();
        assertThat(statuses).containsEntry("t-1", status(3, State.STOPPED));
    }

    @Test
    void triesAgainWhenTheFieldComesThatADeviceLacked() throws Exception {
        take(
                "t-1",
                desired("t-1", 1, true, JsonNodeFactory.instance.objectNode().put("area", "orchard")));
        assertThat(statuses.get("t-1").reason()).startsWith("area: there is no field 'orchard'");

        reconciler.update(Map.of("orchard", WorkField.of(NgsiJson.mapper().readTree(FIELD))));
        statusPublisher.up("t-1");

        assertThat(running).containsExactly("t-1");
        assertThat(statuses).containsEntry("t-1", status(1, State.RUNNING));
    }

    @Test
    void doesNotStartWhatWasDeletedWhileItLackedSomething() throws Exception {
        take(
                "t-1",
                desired("t-1", 1, true, JsonNodeFactory.instance.objectNode().put("area", "orchard")));
        take("t-1", null);
        reconciler.update(Map.of("orchard", WorkField.of(NgsiJson.mapper().readTree(FIELD))));

        assertThat(running).isEmpty();
        assertThat(statuses).containsEntry("t-1", null);
    }

    /** The records of a device and of its mission's list are on two topics: either may come first. */
    @Test
    void waitsForTheSettingsOfADevice() {
        MissionDeviceList list = new MissionDeviceList(
                "weeding",
                0,
                5,
                JsonNodeFactory.instance.arrayNode().add(path(-3.5).put("type", "Thermometer")));
        DesiredDevice device = inGroup(desired("t-1", 6, true, JsonNodeFactory.instance.objectNode()), 5);
        take("t-1", device);
        assertThat(running).isEmpty();
        assertThat(statuses).isEmpty();
        reconciler.forgetAllBut(Set.of("t-1"));
        assertThat(statuses).isEmpty();

        reconciler.takeLists(Map.of(list.key(), list.toBytes()));
        statusPublisher.up("t-1");
        assertThat(running).containsExactly("t-1");
        assertThat(statuses).containsEntry("t-1", status(6, State.RUNNING));

        take("t-1", inGroup(desired("t-1", 9, true, JsonNodeFactory.instance.objectNode()), 8));
        take("t-1", desired("t-1", 10, false, JsonNodeFactory.instance.objectNode()));
        assertThat(running).isEmpty();
        reconciler.takeLists(Map.of(list.key(), new MissionDeviceList("weeding", 0, 8, list.devices()).toBytes()));
        assertThat(running).isEmpty();
    }

    private static DesiredDevice inGroup(DesiredDevice device, long sequence) {
        return new DesiredDevice(
                device.version(),
                device.type(),
                device.device(),
                device.running(),
                device.period(),
                true,
                device.settings(),
                new GroupRef(0, 0, 0, sequence),
                device.generation());
    }

    @Test
    void runsOneOfTwoDevicesOfOneId() {
        take("a", desired("t-1", 1, true, path(-3.5)));
        take("b", desired("t-1", 2, true, path(-3.5)));

        assertThat(statuses.get("b").reason()).isEqualTo("device: 't-1' runs here already, for a");
        assertThat(running).containsExactly("t-1");
    }

    @Test
    void takesBackWhatIsReportedOfDevicesThatAreNotDesired() {
        take("t-1", desired("t-1", 1, true, path(-3.5)));
        statusPublisher.up("t-1");
        reconciler.forgetAllBut(Set.of("t-1", "t-2"));

        assertThat(statuses).containsEntry("t-1", status(1, State.RUNNING)).containsEntry("t-2", null);
    }

    /** Whatever comes, in whatever batches, also twice: in the end that runs which is requested, under its newest sequence. */
    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})
    void endsAsItIsDesired(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        Map<String, DesiredDevice> topic = new TreeMap<>();
        Map<String, DesiredDevice> batch = new LinkedHashMap<>();
        for (int sequence = 1; sequence <= 400; sequence++) {
            String id = "t-" + random.nextInt(8);
            DesiredDevice device = random.nextInt(5) == 0
                    ? null
                    : desired(id, sequence, random.nextInt(3) > 0, path(random.nextInt(3)));
            topic.put(id, device);
            batch.put(id, device);
            if (random.nextInt(3) == 0) {
                reconciler.take(batch);
                batch.clear();
                List<String> up = new ArrayList<>(running);
                Collections.shuffle(up, new java.util.Random(random.nextLong()));
                up.subList(0, up.size() / 2).forEach(statusPublisher::up);
            }
        }
        reconciler.take(batch);
        reconciler.take(topic);
        running.forEach(statusPublisher::up);

        topic.forEach((id, device) -> {
            boolean runs = device != null && device.running();
            assertThat(running.contains(id)).as(id).isEqualTo(runs);
            DeviceStatus status = statuses.get(id);
            if (device == null) {
                assertThat(status).as(id).isNull();
            } else {
                assertThat(status)
                        .as(id)
                        .isEqualTo(status(device.version().sequence(), runs ? State.RUNNING : State.STOPPED));
            }
        });
    }

    private void take(String key, DesiredDevice device) {
        Map<String, DesiredDevice> record = new HashMap<>();
        record.put(key, device);
        reconciler.take(record);
    }

    private static ObjectNode path(double longitude) {
        ObjectNode settings = JsonNodeFactory.instance.objectNode();
        settings.putArray("path").addArray().add(longitude).add(40.3);
        return settings;
    }

    private static DesiredDevice desired(String id, long sequence, boolean runs, ObjectNode settings) {
        DeviceVersion version = new DeviceVersion(
                "urn:" + id, "farm", "/", "farm", "weeding", 1000, runs ? null : Long.valueOf(2000), sequence, null);
        return DesiredDevice.simulated(version, "Thermometer", id, runs, Duration.ofSeconds(1), settings);
    }

    private static DeviceStatus status(long sequence, State state) {
        return new DeviceStatus(sequence, state, null);
    }
}
