package io.furrow.analytics.collision;

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
                .hasMessage("the threshold must be 0.1 to 100000 metres, not " + threshold);
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
}
