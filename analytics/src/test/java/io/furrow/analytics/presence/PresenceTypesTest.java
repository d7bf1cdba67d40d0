package io.furrow.analytics.presence;

import java.util.List;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.analytics.Serializers;
import io.furrow.analytics.position.PositionFix;

class PresenceTypesTest {
    private static final PositionFix FIX = Story.fix("d", 2, 3, 1000);
    private static final Visit STAY = new Visit("f", "North", "farm", 500, true, 900, Cause.SILENT, FIX);

    static Object[] records() {
        return new Object[] {
            STAY,
            new PresenceTransition(PresenceTransition.Phase.LEFT, STAY, 950),
            new PresenceState(FIX, 1000, List.of(STAY, STAY.back())),
            PresenceState.NOWHERE
        };
    }

    @ParameterizedTest
    @MethodSource("records")
    void goThroughFlinksOwnSerializer(Object written) throws Exception {
        Serializers.assertPlain(written);
    }
}
