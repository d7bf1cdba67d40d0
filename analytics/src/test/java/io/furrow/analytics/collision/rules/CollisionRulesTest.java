package io.furrow.analytics.collision.rules;

import java.time.Duration;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class CollisionRulesTest {
    private static final Duration SECOND = Duration.ofSeconds(1);

    @Test
    void takeFiveMetresAndThirtySecondsByDefault() {
        assertThat(CollisionRules.DEFAULT.thresholdMeters()).isEqualTo(5);
        assertThat(CollisionRules.DEFAULT.timeToLive()).hasSeconds(30);
    }

    @ParameterizedTest
    @ValueSource(doubles = {Double.NaN, -1, 0, 0.09, 100_001, Double.POSITIVE_INFINITY})
    void refuseAThresholdThatCannotBeKept(double threshold) {
        assertThatThrownBy(() -> new CollisionRules(threshold, SECOND, SECOND, SECOND, 1e6))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("the threshold must be 0.1 to 100000 meters, not " + threshold);
    }

    @Test
    void refuseTimesAndCellsThatMakeNoSense() {
        Duration negative = Duration.ofMillis(-1);
        assertThatThrownBy(() -> new CollisionRules(5, Duration.ZERO, SECOND, SECOND, 100))
                .hasMessageContaining("time-to-live");
        assertThatThrownBy(() -> new CollisionRules(5, SECOND, negative, SECOND, 100))
                .hasMessageContaining("skew");
        assertThatThrownBy(() -> new CollisionRules(5, SECOND, SECOND, negative, 100))
                .hasMessageContaining("ongoing");
        assertThatThrownBy(() -> new CollisionRules(5, SECOND, SECOND, SECOND, 4.9))
                .hasMessageContaining("cell");
    }

    @Test
    void refuseSteadinessAndLimitsThatMakeNoSense() {
        assertThatThrownBy(() -> new DebounceRules(0.9, SECOND))
                .hasMessage("the leave factor must be 1 to 100, not 0.9");
        assertThatThrownBy(() -> new DebounceRules(1, Duration.ofMillis(-1))).hasMessageContaining("dwell");
        assertThatThrownBy(() -> new CellRules(100, -1)).hasMessageContaining("--crowd");
        assertThatThrownBy(() -> CollisionRules.DEFAULT.with(new DebounceRules(21, SECOND)))
                .hasMessageContaining(
                        "the cell must be at least as high as the threshold at which encounters end, 105.0");
    }

    @Test
    void letTheExactStagesSeeEverythingUpToWhereEncountersEnd() {
        var exact =
                CollisionRules.DEFAULT.with(new DebounceRules(2, Duration.ZERO)).exact();
        assertThat(exact.thresholdMeters()).isEqualTo(10);
        assertThat(exact.ongoingEvery()).isZero();
        assertThat(exact.exact()).isEqualTo(exact);
        assertThat(CollisionRules.DEFAULT.exact()).isSameAs(CollisionRules.DEFAULT);
    }
}
