package io.furrow.analytics.collision.rules;

import java.util.Map;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ThresholdsTest {
    private final Thresholds thresholds =
            new Thresholds(5, Map.of("Robot", 3.0, "Sprayer", 8.0, "Sprayer+Person", 20.0, "Robot+Sprayer", 1.0));

    @Test
    void takeTheGreaterOfBothTypesUnlessThePairIsNamed() {
        assertThat(thresholds.between("Robot", "Robot")).isEqualTo(3);
        assertThat(thresholds.between("Robot", "Person"))
                .as("a person has the common one")
                .isEqualTo(5);
        assertThat(thresholds.between("Person", "Person")).isEqualTo(5);
        assertThat(thresholds.between("Sprayer", "Sprayer")).isEqualTo(8);
        assertThat(thresholds.between("Robot", "Sprayer"))
                .as("named, though less")
                .isEqualTo(1);
    }

    @Test
    void knowAPairInEitherOrder() {
        assertThat(thresholds.between("Person", "Sprayer")).isEqualTo(20);
        assertThat(thresholds.between("Sprayer", "Person")).isEqualTo(20);
        assertThatThrownBy(() -> new Thresholds(5, Map.of("A+B", 1.0, "B+A", 2.0)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("named twice");
    }

    @Test
    void haveAGreatestThatNoPairExceeds() {
        assertThat(thresholds.greatest()).isEqualTo(20);
        assertThat(thresholds.times(1.5).greatest()).isEqualTo(30);
        assertThat(thresholds.times(1.5).between("Robot", "Person")).isEqualTo(7.5);
        assertThat(Thresholds.of(5).greatest()).isEqualTo(5);
    }

    @Test
    void refuseWhatIsNoTypeOrNoDistance() {
        assertThatThrownBy(() -> new Thresholds(5, Map.of("Robot", 0.0)))
                .hasMessage("the threshold of Robot must be 0.1 to 100000 meters, not 0.0");
        assertThatThrownBy(() -> new Thresholds(5, Map.of("Robot+", 4.0)))
                .hasMessage("'Robot+' is neither a type nor two types with + between them");
    }
}
