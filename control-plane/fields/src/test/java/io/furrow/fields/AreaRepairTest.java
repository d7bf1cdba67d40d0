package io.furrow.fields;

import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.field.FieldArea;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.ImportedField;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class AreaRepairTest {
    @TempDir
    private Path folder;

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
        [[[0,0],[2,0],[2,2],[0,2],[0,0]]]                               |
        [[[0,0],[2,0],[2,2],[0,2]]]                                     | closed 1 ring
        [[[0,0],[2,0],[2,0],[2,2],[2,2],[2,2],[0,2],[0,0]]]             | left out 3 repeated corners
        [[[0,0],[0,2],[2,2],[2,0],[0,0]]]                               | reversed 1 ring to the orientation
        [[[0,0,5],[2,0,5],[2,2,5],[0,2,5],[0,0,5]]]                     | left out heights
        [[[0,0],[2,0],[2,2],[0,2],[0,0]],[[1,1],[1,1],[1,1]]]           | left out 1 ring without area
        [[[0,0],[2,0],[2,2],[0,2],[0,0]],[[0.5,0.5],[0.6,0.6],[0.5,0.5]]] | left out 1 ring without area
        [[[0,0],[2,2],[2,0],[0,2],[0,0]]]                               | repaired: Self-intersection at longitude 1.000000, latitude 1.000000
        [[[0,0],[2,0],[2,2],[1,2],[1,3],[1,2],[0,2],[0,0]]]             | repaired: Ring Self-intersection
        [[[0,0],[2,0],[2,2],[0,2],[0,0]],[[3,3],[3,4],[4,4],[3,3]]]     | repaired: Hole lies outside shell
        [[[179,0],[181,0],[181,2],[179,2],[179,0]]]                     | cut at the antimeridian
        [[[179,0],[-179,0],[-179,2],[179,2],[179,0]]]                   | cut at the antimeridian
        [[[-152.4280875922764,23.65356946568013],[-152.42809559227638,23.65356946568013],[-152.4280995922764,23.65358346568013],[-152.4280875922764,23.65358146568013],[-152.42808559227637,23.65358546568013],[-152.4280875922764,23.65356946568013],[-152.4281015922764,23.65356946568013],[-152.4280915922764,23.65357146568013],[-152.4280975922764,23.65356746568013],[-152.4280875922764,23.65356946568013]]] | repaired: Ring Self-intersection
        [[[-179.9999992,-67.06223918172742],[179.9999994,-67.06223778172742],[180.0,-67.06223818172742],[179.9999992,-67.06223778172742],[179.9999992,-67.06223818172742],[179.999999,-67.06223838172743],[179.9999998,-67.06223918172742],[180.0000008,-67.06223858172743],[179.9999992,-67.06223818172742],[180.0000008,-67.06223758172743],[-179.9999992,-67.06223918172742]]] | cut at the antimeridian
        [[[180.006,3.4108496623626556],[180.006,3.4168496623626554],[179.99,3.4208496623626554],[180.0,3.4228496623626556],[179.998,3.4228496623626556],[180.0,3.4068496623626556],[-179.998,3.4068496623626556],[179.998,3.4068496623626556],[179.998,3.4108496623626556],[180.004,3.4068496623626556],[180.006,3.4108496623626556]]] | cut at the antimeridian
        """)
    void reportsRepairs(String coordinates, String note) throws Exception {
        FieldFile read = read("Polygon", coordinates);

        assertThat(read.refused()).isEmpty();
        ImportedField field = read.fields().get(0);
        assertThat(field.hectares()).isPositive();
        if (note == null) {
            assertThat(field.notes()).isEmpty();
        } else {
            assertThat(field.notes()).anySatisfy(one -> assertThat(one).startsWith(note));
        }
        assertThat(FieldArea.read(field.version().geometry(), "as the jobs read it")
                        .isEmpty())
                .isFalse();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
        Point      | [0,0]                                          | is a Point; a field is a Polygon or MultiPolygon
        LineString | [[0,0],[1,1]]                                  | is a LineString
        Polygon    | []                                             | has no ring that encloses an area
        Polygon    | [[[0,0],[1,1]]]                                | has no ring that encloses an area
        Polygon    | [[[0,0],[1,1],[2,2],[0,0]]]                    | encloses no area
        Polygon    | [[[0,0],[1,"a"],[2,2],[0,0]]]                  | has a corner that is not [x, y]
        Polygon    | [[[0,0],[0,91],[2,2],[0,0]]]                   | has the corner 0.0, 91.0 outside of WGS 84
        Polygon    | [[[0,80],[90,80],[180,80],[-90,80],[0,80]]]    | goes round a pole
        MultiPolygon | []                                           | has no geometry
        """)
    void rejectsFeaturesThatCannotBeRepaired(String type, String coordinates, String reason) throws Exception {
        FieldFile read = read(type, coordinates);

        assertThat(read.fields()).isEmpty();
        assertThat(read.refused()).singleElement().satisfies(one -> {
            assertThat(one.number()).isEqualTo(1);
            assertThat(one.id()).isEqualTo("a");
            assertThat(one.reason()).startsWith(reason);
        });
    }

    @Test
    void cutsAtTheAntimeridianWithoutLosingArea() throws Exception {
        ImportedField whole = read("Polygon", "[[[9,0],[11,0],[11,2],[9,2],[9,0]],[[9.5,1],[10.5,1],[10,1.5],[9.5,1]]]")
                .fields()
                .get(0);
        ImportedField cut = read(
                        "Polygon",
                        "[[[179,0],[-179,0],[-179,2],[179,2],[179,0]],[[179.5,1],[-179.5,1],[180,1.5],[179.5,1]]]")
                .fields()
                .get(0);

        assertThat(cut.version().geometry().path("type").asText()).isEqualTo("MultiPolygon");
        assertThat(cut.version().geometry().path("coordinates")).hasSize(2);
        assertThat(cut.hectares()).isCloseTo(whole.hectares(), within(1e-3));
    }

    @Test
    void joinsOverlappingParts() throws Exception {
        ImportedField joined = read(
                        "MultiPolygon", "[[[[0,0],[2,0],[2,2],[0,2],[0,0]]],[[[1,0],[3,0],[3,2],[1,2],[1,0]]]]")
                .fields()
                .get(0);
        ImportedField whole =
                read("Polygon", "[[[0,0],[3,0],[3,2],[0,2],[0,0]]]").fields().get(0);

        assertThat(joined.notes()).singleElement().asString().startsWith("repaired: ");
        assertThat(joined.hectares()).isCloseTo(whole.hectares(), within(1e-3));
    }

    @Test
    void importsValidFeaturesAndReportsTheOthers() throws Exception {
        String area = "\"geometry\": {\"type\": \"Polygon\", \"coordinates\": [[[0,0],[2,0],[2,2],[0,0]]]}";
        Path file = Files.writeString(folder.resolve("some.geojson"), """
            {"type": "FeatureCollection", "features": [
              {"type": "Feature", "id": "a", %1$s}, {"type": "Feature", "id": "a", %1$s}, {"type": "Feature", %1$s},
              {"type": "Feature", "id": "b c", %1$s}, {"type": "Feature", "id": 7, %1$s},
              {"type": "Feature", "id": "d", "geometry": null}]}\
            """.formatted(area));

        FieldFile read = FieldFiles.read(file, FieldFilesTest.PLAIN);

        assertThat(read.fields()).extracting(field -> field.version().id()).containsExactly("a", "7");
        assertThat(read.refused())
                .extracting(one ->
                        one.number() + " " + one.id() + ": " + one.reason().replaceFirst(";.*", ""))
                .containsExactly(
                        "2 a: has the id of feature 1",
                        "3 : has no id",
                        "4 b c: has the id 'b c', which is not a valid entity id",
                        "6 d: has no geometry");
    }

    private FieldFile read(String type, String coordinates) throws Exception {
        String json = "{\"type\": \"Feature\", \"id\": \"a\", \"geometry\": {\"type\": \"%s\", \"coordinates\": %s}}";
        Path file = Files.writeString(folder.resolve("one.geojson"), json.formatted(type, coordinates));
        return FieldFiles.read(file, FieldFilesTest.PLAIN);
    }
}
