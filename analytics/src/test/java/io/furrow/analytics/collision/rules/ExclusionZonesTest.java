package io.furrow.analytics.collision.rules;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.ObjectInputStream;
import java.io.ObjectOutputStream;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ExclusionZonesTest {
    /** A square around 10° E 50° N with a hole, and one up to the antimeridian. */
    private static final String YARDS = """
            {"type": "FeatureCollection", "features": [
              {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [
                [[9, 49], [11, 49], [11, 51], [9, 51], [9, 49]],
                [[9.5, 49.5], [9.5, 50.5], [10.5, 50.5], [10.5, 49.5], [9.5, 49.5]]]}},
              {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [
                [[[179, -1], [180, -1], [180, 1], [179, 1], [179, -1]]]]}}]}""";

    @TempDir
    private Path folder;

    @Test
    void coverWhatIsInsideAndOnTheBoundary() throws Exception {
        ExclusionZones zones = zones(YARDS);

        assertThat(zones.cover(49.2, 9.2)).isTrue();
        assertThat(zones.cover(49, 10)).as("on the boundary").isTrue();
        assertThat(zones.cover(Math.nextDown(49.0), 10)).isFalse();
        assertThat(zones.cover(50, 10)).as("in the hole").isFalse();
        assertThat(zones.cover(50, 9.5)).as("on the boundary of the hole").isTrue();
        assertThat(ExclusionZones.NONE.cover(49.2, 9.2)).isFalse();
    }

    @Test
    void knowOneMeridianByItsTwoLongitudes() throws Exception {
        ExclusionZones zones = zones(YARDS);

        assertThat(zones.cover(0, 180)).isTrue();
        assertThat(zones.cover(0, -180)).isTrue();
        assertThat(zones.cover(0, Math.nextUp(-180.0))).isFalse();
    }

    @Test
    void stayThemselvesOnTheWayToTheTaskManagers() throws Exception {
        ExclusionZones zones = zones(YARDS);
        assertThat(zones.cover(49.2, 9.2)).isTrue();
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        new ObjectOutputStream(bytes).writeObject(zones);
        Object read = new ObjectInputStream(new ByteArrayInputStream(bytes.toByteArray())).readObject();

        assertThat(read).isEqualTo(zones);
        assertThat(((ExclusionZones) read).cover(49.2, 9.2)).isTrue();
    }

    @Test
    void refuseAFileOfWhichAZoneWouldBeMissing() {
        assertThatThrownBy(() -> ZoneFile.read(folder.resolve("none")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("cannot be read; name a readable GeoJSON file");
        assertRefused("{", "is not JSON");
        assertRefused("{}", "holds no feature");
        assertRefused(feature("{'type': 'Point', 'coordinates': [1, 2]}"), "feature 1 is not an area");
        assertRefused(feature("{'type': 'Polygon', 'coordinates': [[[1, 2]]]}"), "feature 1 has broken coordinates");
        assertRefused(
                feature("{'type': 'Polygon', 'coordinates': [[[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]]}"),
                "feature 1 is not a valid area: Self-intersection");
        assertRefused(
                feature("{'type': 'Polygon', 'coordinates': [[[0, 0], [2, 0], [2, 91], [0, 0]]]}"),
                "lies outside of longitude ±180, latitude ±90");
    }

    private void assertRefused(String text, String why) {
        assertThatThrownBy(() -> zones(text))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContainingAll("--zones ", why);
    }

    private static String feature(String geometry) {
        return "{'features': [{'geometry': %s}]}".formatted(geometry).replace('\'', '"');
    }

    private ExclusionZones zones(String text) throws Exception {
        return ZoneFile.read(Files.writeString(folder.resolve("yards.geojson"), text));
    }
}
