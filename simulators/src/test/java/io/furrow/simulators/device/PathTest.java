package io.furrow.simulators.device;

import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Position;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class PathTest {
    private static final Position SOUTH = new Position(40.3100, -3.48);
    private static final Position CORNER = new Position(40.3109, -3.48);
    private static final Position EAST = new Position(40.3109, -3.479);

    @Test
    void staysWhereThereIsOnePoint() {
        assertThat(new Path(List.of(SOUTH), 3, 7).at(Duration.ofHours(1))).isEqualTo(SOUTH);
    }

    @Test
    void goesItsSpeedAlongBothStretches() {
        Path path = new Path(List.of(SOUTH, CORNER, EAST), 2, 0);

        assertThat(Path.meters(SOUTH, path.at(Duration.ofSeconds(10)))).isEqualTo(20, within(0.01));
        double first = Path.meters(SOUTH, CORNER);
        assertThat(Path.meters(CORNER, path.at(Duration.ofSeconds(70)))).isEqualTo(140 - first, within(0.01));
    }

    @Test
    void turnsRoundAtTheEndAndAgainAtTheStart() {
        double length = Path.meters(SOUTH, CORNER);
        Path path = new Path(List.of(SOUTH, CORNER), length, 0);

        assertThat(Path.meters(SOUTH, path.at(Duration.ofMillis(1_250)))).isEqualTo(0.75 * length, within(0.01));
        assertThat(Path.meters(SOUTH, path.at(Duration.ofMillis(2_250)))).isEqualTo(0.25 * length, within(0.01));
    }

    @Test
    void setsOutFromItsStart() {
        assertThat(Path.meters(SOUTH, new Path(List.of(SOUTH, CORNER), 1, 30).at(Duration.ZERO)))
                .isEqualTo(30, within(0.01));
    }
}
