package io.furrow.control;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** A broker that was killed may let a group read again what it has read. */
class ReadAgainTest {
    private static final String LINE = FarmWatch.APPLICATION + "-collisions-repartition";

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void raisesNoSecondAlarmOfAnEncounterThatHasEnded() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofSeconds(1));
        farm.encounter("ended", 3.2);
        farm.pass(Duration.ofSeconds(31)); // that it stays away, so that one at the border has one alarm
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        List<TestRecord<String, byte[]>> before = farm.read(LINE);
        assertThat(before).hasSize(2);

        before.forEach(record -> farm.pipe(LINE, record));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();

        farm.encounter("started", 3.2);
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("open");
    }
}
