package io.furrow.control;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** After a broker was killed, a consumer group may read records again. */
class ReadAgainTest {
    private static final String REPARTITIONED = FarmWatch.APPLICATION + "-collisions-repartition";

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void raisesNoSecondAlarmForAnEndedEncounter() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofSeconds(1));
        farm.encounter("ended", 3.2);
        farm.pass(Duration.ofSeconds(31)); // longer than a collision lasts after the end of its encounter
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        List<TestRecord<String, byte[]>> before = farm.read(REPARTITIONED);
        assertThat(before).hasSize(2);

        before.forEach(record -> farm.pipe(REPARTITIONED, record));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();

        farm.encounter("started", 3.2);
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("open");
    }
}
