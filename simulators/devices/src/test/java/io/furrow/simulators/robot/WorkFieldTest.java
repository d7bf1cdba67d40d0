package io.furrow.simulators.robot;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.position.Position;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

class WorkFieldTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    {"type": "Polygon"}                                                          | a field is a GeoJSON Feature with an id
                    {"type": "Feature", "geometry": {"type": "Polygon"}}                         | a field is a GeoJSON Feature with an id
                    {"type": "Feature", "id": "f", "geometry": {"type": "MultiPolygon"}}         | the geometry of field 'f' is not a Polygon: make each part of a MultiPolygon a field of its own
                    {"type": "Feature", "id": "f", "geometry": {"type": "Polygon", "coordinates": []}} | the Polygon of field 'f' has no ring
                    {"type": "Feature", "id": "f", "geometry": {"type": "Polygon", "coordinates": [[[1, "x"]]]}} | a corner of field 'f' is no [longitude, latitude]: [1,"x"]
                    {"type": "Feature", "id": "f", "geometry": {"type": "Polygon", "coordinates": [[[1, 2], [2, 2], [2, 3], [1, 3]]]}} | a ring of field 'f' is not closed: its last corner is its first, with at least two between
                    {"type": "Feature", "id": "f", "geometry": {"type": "Polygon", "coordinates": [[[1, 1], [2, 2], [2, 1], [1, 2], [1, 1]]]}} | the Polygon of field 'f' is not valid at 1.500000, 1.500000: Self-intersection
                    """)
    void reportsWhatIsWrong(String feature, String sentence) throws Exception {
        var json = NgsiJson.mapper().readTree(feature);

        assertThatThrownBy(() -> WorkField.of(json))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage(sentence);
    }

    @Test
    void findsPlacesAgain() {
        LocalPlane plane = new LocalPlane(new Position(40.31, -3.48));
        Position place = new Position(40.32, -3.47);

        Position again = plane.toPosition(plane.toMeters(place));

        assertThat(again.latitude()).isEqualTo(place.latitude(), within(1e-12));
        assertThat(again.longitude()).isEqualTo(place.longitude(), within(1e-12));
        assertThat(plane.toMeters(place).y).isEqualTo(1111.9, within(0.1));
        assertThat(plane.toMeters(place).x).isEqualTo(847.9, within(0.1));
    }
}
