package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.Replayed;
import io.furrow.analytics.Seeds;
import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;

import static io.furrow.analytics.collision.ReportedRun.START;
import static io.furrow.analytics.collision.ReportedRun.options;
import static io.furrow.analytics.collision.ReportedRun.robot;
import static io.furrow.analytics.collision.ReportedRun.run;

/** Four robots to and fro on 40 meters for a minute, played four times. */
class CollisionReplayTest {
    private static final Logger LOG = LoggerFactory.getLogger(CollisionReplayTest.class);

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    @ParameterizedTest
    @ValueSource(strings = {"", " --dwell 2s --leave-factor 2 --crossed --horizon 5s --crowd 1"})
    void tellsOfEachEpochWhatItTellsOfItAlone(String more) throws Exception {
        CollisionOptions options = options(("--input " + Replayed.TOPIC + more).split(" "));

        Replayed.assertThatEpochsAreAsAlone(
                Replayed.epochs(arrivals(), START + 20_000),
                records -> run(options, records.toArray(TopicRecord[]::new)));
    }

    /** Up to 1.5 s in disorder. */
    private static List<TopicRecord> arrivals() {
        long seed = Long.getLong("collision.seed", System.nanoTime());
        LOG.info("replay of robots from seed {}", seed);
        Random random = Seeds.random(seed);
        Map<TopicRecord, Long> delays = new HashMap<>();
        List<TopicRecord> arrivals = new ArrayList<>();
        for (int robot = 1; robot <= 4; robot++) {
            double east = random.nextInt(40);
            for (long time = random.nextInt(1000); time < 60_000; time += 1000 + random.nextInt(100)) {
                east = Math.max(0, Math.min(40, east + random.nextDouble(-6, 6)));
                TopicRecord record = robot("r" + robot, east, time);
                arrivals.add(record);
                delays.put(record, time + random.nextInt(1500));
            }
        }
        arrivals.sort(Comparator.comparing(delays::get));
        return arrivals;
    }
}
