package io.furrow.analytics.collision.motion;

import java.util.List;
import java.util.Map;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.analytics.Serializers;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.position.PositionFix;

class MotionTypesTest {
    private static final PositionFix FIX = Courses.fix("a", new double[] {40.5, -3.25}, 1000);
    private static final MotionSegment LEG = new MotionSegment(FIX, 0, 1000, 1, 2, 3, 0.1, 0.2, 0.3);
    private static final ApproachCandidate FINDING =
            new ApproachCandidate(FIX, FIX, 1000, 9, 3, 500.5, 0, 1000, 400, 600, true);

    static Object[] records() {
        return new Object[] {
            LEG,
            new SegmentUpdate(-7, 1000, SegmentUpdate.Change.PREDICTION_ENDED, LEG),
            new MotionState(FIX, LEG),
            new MotionState(FIX, null),
            new MovingDevice(LEG, List.of(LEG, LEG)),
            new MovingDevice(null, List.of()),
            new CubeIndex(Map.of(FIX.key(), new MovingDevice(null, List.of(LEG)))),
            FINDING,
            new OngoingPrediction(1, 2, 3),
            new Contact(FINDING, 1, 2, true),
            new Approach(Phase.CROSSED, FIX, FIX, 1, 2, 3, 4, 5)
        };
    }

    @ParameterizedTest
    @MethodSource("records")
    void goThroughFlinksOwnSerializer(Object written) throws Exception {
        Serializers.assertPlain(written);
    }
}
