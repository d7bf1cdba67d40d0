package io.furrow.analytics.collision.grid;

import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.Fixes;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class GeodesyTest {
    @Test
    void measuresAlongMeridiansAndTheEquator() {
        assertThat(distance(0, 0, 1, 0)).isCloseTo(111_194.926_644, within(1e-6));
        assertThat(distance(0, 0, 0, 1)).isCloseTo(111_194.926_644, within(1e-6));
        assertThat(distance(60, 10, 60, 11)).isCloseTo(55_595.4, within(5.0));
        assertThat(distance(0, 0, 0, 180)).isEqualTo(Math.PI * Geodesy.EARTH_RADIUS_METERS);
        assertThat(distance(90, 0, -90, 77)).isEqualTo(Math.PI * Geodesy.EARTH_RADIUS_METERS);
    }

    @Test
    void seesNoBorderAtTheAntimeridianAndOnePointAtAPole() {
        assertThat(distance(10, 180, 10, -180)).isZero();
        assertThat(distance(0, 179.99999, 0, -179.99999)).isCloseTo(2.223_898_5, within(1e-6));
        assertThat(distance(90, 0, 90, 123)).isLessThan(1e-9);
        assertThat(distance(89.99999, 0, 89.99999, 180)).isCloseTo(2.223_898_5, within(1e-6));
    }

    private static double distance(double latitude, double longitude, double otherLatitude, double otherLongitude) {
        return Geodesy.distance(Fixes.at("a", latitude, longitude, 0), Fixes.at("b", otherLatitude, otherLongitude, 0));
    }
}
