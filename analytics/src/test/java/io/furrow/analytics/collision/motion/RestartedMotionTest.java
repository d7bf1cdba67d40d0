package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.encounter.Stage;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.time.KeyedLatenessOperator;

import static io.furrow.analytics.collision.motion.Courses.START;
import static org.assertj.core.api.Assertions.assertThat;

class RestartedMotionTest {
    private static final long BOUND = 1500;

    private final Random random = new Random(20261121);

    @Test
    void tellsTheSameHoweverOftenItRestartsAndKeepsNothingInTheEnd() throws Exception {
        int told = 0;
        for (int i = 0; i < 12; i++) {
            MotionRules rules = Courses.rules(20);
            Courses courses = new Courses(300 + i);
            List<PositionFix> fixes = courses.world(Courses.CENTRES[i % Courses.CENTRES.length], START);
            List<Approach> expected =
                    MotionSimulationTest.sorted(MotionSimulation.approaches(fixes, rules, new Random(i)));

            List<Approach> found = restarted(courses.shuffled(fixes, BOUND), rules);

            assertThat(MotionSimulationTest.sorted(found)).isEqualTo(expected);
            told += expected.size();
        }
        assertThat(told).isGreaterThan(12);
    }

    @Test
    void leavesOutWhatComesBehindTheWatermarkAlsoAfterARestart() throws Exception {
        MotionRules rules = Courses.rules(20);
        var track = track(rules);
        track.receive(List.of(Courses.fix("a", new double[] {40, 3}, 1, 90, START)));
        assertThat(track.advance(START + 10)).isNotEmpty();
        track.restart();

        track.receive(List.of(Courses.fix("b", new double[] {40, 3}, 1, 90, START + 10)));
        track.receive(List.of(Courses.fix("c", new double[] {40, 3}, 1, 90, START + 11)));

        assertThat(track.advance(START + 20))
                .isNotEmpty()
                .extracting(update -> update.segment().fix().id())
                .containsOnly("c");
        track.stop();
    }

    private static Stage<String, PositionFix, SegmentUpdate> track(MotionRules rules) throws Exception {
        return Stage.of(() -> new KeyedLatenessOperator<>(new TrackMotion(rules)), PositionFix::key, Types.STRING);
    }

    private List<Approach> restarted(List<PositionFix> arrivals, MotionRules rules) throws Exception {
        var track = track(rules);
        Stage<Long, SegmentUpdate, ApproachCandidate> match =
                Stage.of(() -> new KeyedProcessOperator<>(new MatchSegments(rules)), SegmentUpdate::cube, Types.LONG);
        Stage<String, ApproachCandidate, Approach> predict = Stage.of(
                () -> new KeyedProcessOperator<>(new TrackPredictions(rules)), ApproachCandidate::pair, Types.STRING);
        Stage<String, ApproachCandidate, Approach> join = Stage.of(
                () -> new KeyedProcessOperator<>(new JoinContacts(rules)), ApproachCandidate::pair, Types.STRING);
        List<Stage<?, ?, ?>> stages = List.of(track, match, predict, join);
        List<Approach> approaches = new ArrayList<>();
        long newest = Long.MIN_VALUE;
        for (int i = 0; i <= arrivals.size(); i++) {
            boolean end = i == arrivals.size();
            if (!end) {
                track.receive(List.of(arrivals.get(i)));
                newest = Math.max(newest, arrivals.get(i).time());
            }
            if (random.nextInt(10) == 0) {
                stages.get(random.nextInt(stages.size())).restart();
            }
            if (end || random.nextInt(4) == 0) {
                long watermark = end ? Long.MAX_VALUE : newest - BOUND - 1;
                List<SegmentUpdate> updates = track.advance(watermark);
                Collections.shuffle(updates, random);
                match.receive(updates);
                List<ApproachCandidate> candidates = match.advance(watermark);
                Collections.shuffle(candidates, random);
                predict.receive(candidates);
                List<ApproachCandidate> contacts = match.aside(MatchSegments.CONTACTS);
                Collections.shuffle(contacts, random);
                join.receive(contacts);
                approaches.addAll(predict.advance(watermark));
                approaches.addAll(join.advance(watermark));
            }
        }
        for (Stage<?, ?, ?> stage : stages) {
            stage.stopEmpty();
        }
        return approaches;
    }
}
