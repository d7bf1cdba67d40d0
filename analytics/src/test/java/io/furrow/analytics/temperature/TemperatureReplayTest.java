package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Random;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.Replayed;
import io.furrow.analytics.Seeds;
import io.furrow.flink.record.TopicRecord;

import static org.assertj.core.api.Assertions.assertThat;

/** Four thermometers of which one is defective, that fall silent for half a minute, in windows of 7 s: no span of an epoch is a multiple of that. */
@Timeout(60)
class TemperatureReplayTest {
    private static final Logger LOG = LoggerFactory.getLogger(TemperatureReplayTest.class);
    private static final String[] OPTIONS = {"--input", Replayed.TOPIC, "--window", "14s", "--slide", "7s"};
    private static final long START = 1_700_000_000_000L;

    @RegisterExtension
    static final MiniClusterExtension FLINK = InTurn.cluster(2);

    @Tag("full")
    @Test
    void averagesEachEpochAsItAveragesItAlone() throws Exception {
        Replayed.assertThatEpochsAreAsAlone(
                Replayed.epochs(arrivals(), START + 20_000),
                records -> JobRun.over(records, OPTIONS).records());
    }

    @Test
    void countsNothingThatOnlyTellsWhereAnEpochBegins() throws Exception {
        List<TopicRecord> again = Replayed.epochs(arrivals(), START + 20_000).get(1);
        List<TopicRecord> events = again.stream()
                .filter(record -> "event".equals(record.headers().get("replay-kind")))
                .toList();

        assertThat(events).hasSizeLessThan(again.size());
        assertThat(Replayed.ofEpoch(JobRun.over(again, OPTIONS).records(), 1))
                .isEqualTo(Replayed.ofEpoch(JobRun.over(events, OPTIONS).records(), 1))
                .isNotEmpty();
    }

    private static List<TopicRecord> arrivals() {
        long seed = Long.getLong("temperature.seed", System.nanoTime());
        LOG.info("replay of thermometers from seed {}", seed);
        Random random = Seeds.random(seed);
        List<TopicRecord> arrivals = new ArrayList<>();
        for (int device = 0; device < 4; device++) {
            for (long time = random.nextInt(3_000); time < 100_000; time += 1_000 + random.nextInt(2_000)) {
                if (time < 40_000 || time > 70_000) {
                    double temperature = (device == 3 ? 60 : 18) + random.nextDouble();
                    arrivals.add(Farm.north("t" + device, temperature, START + time));
                }
            }
        }
        arrivals.sort(Comparator.comparingLong(TopicRecord::timestamp));
        return arrivals;
    }
}
