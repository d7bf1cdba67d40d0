package io.furrow.ingest.route;

import java.util.Map;

import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.junit.jupiter.api.Test;

import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class AssignMissionTest extends AssignMissionFixture {
    @Test
    void prefersTheEventThenTheDevicesThenTheDefault() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));

        report("robot", 100, "north", "mowing");
        report("robot", 100, "", "");
        report("robot", 99, "", "");
        report("stranger", 100, "", "");
        report("robot", 100, "farm", "");
        report("robot", 100, "north", "");

        assertThat(routes())
                .containsExactly("north/mowing", "farm/weeding", "home/", "home/", "farm/weeding", "north/");
    }

    @Test
    void assignsALateEventByItsEventTime() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));
        broadcast(1, version("robot", "farm", "sowing", 200, 2));

        report("robot", 250, "", "");
        report("robot", 150, "", "");

        assertThat(routes()).containsExactly("farm/sowing", "farm/weeding");
    }

    @Test
    void usesTheSnapshotBeforeTheStreamOfDevices() throws Exception {
        operator.close();
        snapshot(0, version("robot", "farm", "weeding", 100, 1));
        snapshot(1, version("robot", "farm", "sowing", 200, 2));
        create();
        operator.open();

        report("robot", 250, "", "");
        broadcast(0, version("robot", "farm", "weeding", 100, 1)); // the stream lags behind the snapshot
        report("robot", 250, "", "");
        broadcast(1, version("robot", "farm", "sowing", 200, 2));
        broadcast(2, version("robot", "farm", "mowing", 240, 3));
        report("robot", 250, "", "");

        assertThat(routes()).containsExactly("farm/sowing", "farm/sowing", "farm/mowing");
    }

    @Test
    void routesADeletionLikeTheNewestEventAndClearsTheState() throws Exception {
        report("robot", 200, "farm", "sowing");
        report("robot", 100, "farm", "weeding");
        delete("robot", 300);
        assertThat(operator.numKeyedStateEntries()).isZero();
        delete("robot", 301);

        assertThat(routes()).containsExactly("farm/sowing", "farm/weeding", "farm/sowing", "home/");
    }

    @Test
    void retainsTheRouteOfAnEntityRecreatedBeforeItsDeletionArrives() throws Exception {
        report("robot", 200, "farm", "sowing");
        delete("robot", 150);
        delete("robot", 300);

        assertThat(routes()).containsExactly("farm/sowing", "farm/sowing", "farm/sowing");
        assertThat(operator.numKeyedStateEntries()).isZero();
    }

    @Test
    void clearsTheStateAtADeletionAfterReportsOfAClockThatIsAhead() throws Exception {
        event("robot", 260, 200, "farm", "sowing", new byte[0]);
        delete("robot", 205);

        assertThat(routes()).containsExactly("farm/sowing", "farm/sowing");
        assertThat(operator.numKeyedStateEntries()).isZero();
    }

    @Test
    void clearsDevicesAfterTheirRetention() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));
        broadcast(1, new DeviceChange("|/|robot", 0, 1, 200, null));
        report("robot", 150, "", "");
        assertThat(operator.getOperator()
                        .getOperatorStateBackend()
                        .getBroadcastState(AssignMission.DEVICES)
                        .contains("|/|robot"))
                .isTrue();

        broadcast(2, new DeviceChange("|/|other", 0, 2, 1201, null));

        assertThat(operator.getOperator()
                        .getOperatorStateBackend()
                        .getBroadcastState(AssignMission.DEVICES)
                        .entries())
                .isEmpty();
        report("robot", 150, "", "");
        assertThat(routes()).containsExactly("farm/weeding", "home/");
    }

    @Test
    void restoresDevicesAndRoutesAfterARestart() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));
        report("robot", 200, "north", "mowing");
        OperatorSubtaskState state = operator.snapshot(1, 1);
        operator.close();
        snapshot(1, new DeviceChange("|/|robot", 0, 1, 300, null));
        create();
        operator.initializeState(state);
        operator.open();

        report("robot", 150, "", "");
        report("robot", 300, "", "");
        delete("robot", 400);

        assertThat(routes())
                .as("the device ended while the job was down")
                .containsExactly("farm/weeding", "home/", "home/");
    }

    @Test
    void rejectsTheMissionOfAnotherDomain() throws Exception {
        operator.close();
        domains.add(managed("north", "{}"));
        domains.add(managed("south", "{}"));
        missions.add(managed("weeding", "{'domain':'north','created':400}"));
        create();
        operator.open();

        report("robot", 500, "south", "weeding");
        report("robot", 399, "south", "weeding"); // of an earlier mission of this name
        report("robot", 500, "west", "weeding"); // not of this control plane

        assertThat(routes()).containsExactly("south/", "south/weeding", "west/weeding");
        assertThat(deadLetters())
                .extracting(deadLetter -> deadLetter.headers().get("dead-message"))
                .containsExactly("mission weeding belongs to domain north, the event to domain south");
    }

    private void snapshot(long offset, DeviceVersion version) {
        snapshot.add(new TopicRecord(Topics.DEVICES, 0, offset, 0, new byte[0], version.toBytes(), Map.of()));
    }

    private void snapshot(long offset, DeviceChange end) {
        byte[] key = end.key().getBytes(UTF_8);
        snapshot.add(new TopicRecord(Topics.DEVICES, 0, offset, end.time(), key, null, Map.of()));
    }

    private void broadcast(long offset, DeviceVersion version) throws Exception {
        broadcast(offset, new DeviceChange(version.key(), 0, offset, version.from(), version));
    }

    private void broadcast(long offset, DeviceChange change) throws Exception {
        operator.processElement2(new StreamRecord<>(change, offset));
    }

    private static DeviceVersion version(String id, String domain, String mission, long from, long sequence) {
        return new DeviceVersion(id, "", "/", domain, mission, from, null, sequence, null);
    }
}
