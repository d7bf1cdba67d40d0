package io.furrow.flink.device;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceVersion;

import static org.assertj.core.api.Assertions.assertThat;

class DeviceVersionsTest {
    @Test
    void knowsTheMissionAsOfATime() {
        DeviceVersions history = DeviceVersions.EMPTY.with(change("a", 100, 1)).with(change("b", 200, 2));

        assertThat(history.at(99)).isEmpty();
        assertThat(missionAt(history, 100)).isEqualTo("a");
        assertThat(missionAt(history, 199)).isEqualTo("a");
        assertThat(missionAt(history, 200)).isEqualTo("b");
        assertThat(missionAt(history, Long.MAX_VALUE)).isEqualTo("b");
    }

    @Test
    void knowsNoMissionBetweenAnEndAndTheNextBeginning() {
        DeviceVersion ending = new DeviceVersion("r", "", "/", "d", "a", 100, 150L, 1, null);
        DeviceVersions history = DeviceVersions.EMPTY
                .with(new DeviceChange("|/|r", 0, 0, 0, ending))
                .with(change("b", 200, 2));

        assertThat(missionAt(history, 149)).isEqualTo("a");
        assertThat(history.at(150)).isEmpty();
        assertThat(missionAt(history, 200)).isEqualTo("b");
    }

    @Test
    void letsANewerVersionSayOtherwiseOfATimeThatAnOlderOneSpokeOf() {
        DeviceVersions history = DeviceVersions.EMPTY
                .with(change("a", 100, 1))
                .with(change("b", 200, 2))
                .with(change("c", 150, 3));

        assertThat(missionAt(history, 120)).isEqualTo("a");
        assertThat(missionAt(history, 160)).isEqualTo("c");
        assertThat(missionAt(history, 250)).isEqualTo("c");
    }

    @Test
    void passesOverAVersionThatIsOutOfDateAndARepeatedOne() {
        DeviceVersions history = DeviceVersions.EMPTY.with(change("a", 100, 5)).with(change("b", 200, 7));

        assertThat(history.with(change("old", 50, 6))).isEqualTo(history);
        assertThat(history.with(change("b", 200, 7))).isEqualTo(history);
    }

    @Test
    void endsWithTheDeletionAndKeepsWhatWasBeforeIt() {
        var history = DeviceVersions.EMPTY.with(change("a", 100, 1)).with(new DeviceChange("|/|r", 0, 0, 300, null));

        assertThat(missionAt(history, 299)).isEqualTo("a");
        assertThat(history.at(300)).isEmpty();
    }

    @Test
    void forgetsWhatHadEndedAtATime() {
        DeviceVersions history = DeviceVersions.EMPTY.with(change("a", 100, 1)).with(change("b", 200, 2));

        assertThat(history.since(199)).isSameAs(history);
        assertThat(history.since(200).versions()).hasSize(1);
        assertThat(missionAt(history.since(200), 200)).isEqualTo("b");
        assertThat(history.with(new DeviceChange("|/|r", 0, 0, 300, null))
                        .since(300)
                        .isEmpty())
                .isTrue();
    }

    private static String missionAt(DeviceVersions history, long time) {
        return history.at(time).orElseThrow().mission();
    }

    private static DeviceChange change(String mission, long from, long sequence) {
        return new DeviceChange(
                "|/|r", 0, sequence, from, new DeviceVersion("r", "", "/", "d", mission, from, null, sequence, null));
    }
}
