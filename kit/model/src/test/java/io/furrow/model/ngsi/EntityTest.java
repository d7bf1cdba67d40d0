package io.furrow.model.ngsi;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

class EntityTest {
    @Test
    void readsBackItsBytes() throws Exception {
        Entity entity = Entity.builder("urn:ngsi-ld:Thermometer:1", "Thermometer")
                .text("Location", "dehesa Ñ 🚜")
                .number("Temperature", 21.5)
                .integer("Time", 1_700_000_000_000L)
                .bool("Status", true)
                .texts("suspects", List.of("a", "b"))
                .build();

        Entity read = Entity.parse(entity.toBytes());

        assertThat(read.toBytes()).isEqualTo(entity.toBytes());
        assertThat(read.text("Location")).contains("dehesa Ñ 🚜");
        assertThat(read.number("Temperature")).contains(21.5);
        assertThat(read.attributes())
                .extracting("key")
                .containsExactly("Location", "Temperature", "Time", "Status", "suspects");
    }

    @Test
    void hasNoValueIfItIsNullOrMissing() throws Exception {
        Entity entity =
                parse("{\"id\":\"a\",\"none\":{\"value\":null},\"blank\":{\"value\":\" \"},\"x\":{\"value\":1}}");

        assertThat(entity.value("x")).isPresent();
        assertThat(entity.value("none")).isEmpty();
        assertThat(entity.value("missing")).isEmpty();
        assertThat(entity.value("id")).isEmpty();
        assertThat(entity.value("type")).isEmpty();
        assertThat(entity.text("blank")).isEmpty();
        assertThat(entity.text("x")).isEmpty();
    }

    /** The tests of the dashboard's page use the same table. */
    @ParameterizedTest
    @CsvFileSource(resources = "commands.csv", delimiter = '|', quoteCharacter = '\u0001')
    void recognizesCommands(String name, String attribute, boolean isOfCommand) throws Exception {
        assertThat(Entity.isOfCommand(name, NgsiJson.read(attribute.getBytes(UTF_8))))
                .isEqualTo(isOfCommand);
    }

    @Test
    void isAThingWithoutAType() throws Exception {
        assertThat(parse("{\"id\":\"a\"}").type()).isEqualTo("Thing");
        assertThat(parse("{\"id\":\"a\",\"type\":\"Robot\"}").type()).isEqualTo("Robot");
    }

    @ParameterizedTest
    @ValueSource(strings = {"a b", "urn:ngsi-ld:Ñandú:1", "X"})
    void acceptsAnyTextAsAnId(String id) throws Exception {
        String longId = id.repeat(300);

        assertThat(parse("{\"id\":\"" + id + "\"}").id()).isEqualTo(id);
        assertThat(parse("{\"id\":\"" + longId + "\"}").id()).isEqualTo(longId);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
            21.5            | 21.5
            "21.5"          | 21.5
            " -3e2 "        | -300
            ".5"            | 0.5
            "7."            | 7
            1e400           | -
            "1e400"         | -
            "NaN"           | -
            "Infinity"      | -
            "0x10"          | -
            "1d"            | -
            "21,5"          | -
            ""              | -
            true            | -
            [1]             | -
            """)
    void readsANumberAlsoFromText(String value, Double expected) throws Exception {
        assertThat(parse("{\"id\":\"a\",\"x\":{\"value\":" + value + "}}").number("x"))
                .isEqualTo(java.util.Optional.ofNullable(expected));
    }

    @ParameterizedTest
    @ValueSource(strings = {"id", "type"})
    void rejectsAnAttributeNamedIdOrType(String name) {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Entity.builder("a", "T").text(name, "b"))
                .withMessageContaining("'" + name + "'");
    }

    @ParameterizedTest
    @ValueSource(doubles = {Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY})
    void rejectsNumbersThatJsonCannotExpress(double number) {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> Entity.builder("a", "T").number("x", number))
                .withMessageContaining("x is not finite");
    }

    private static Entity parse(String json) throws UnreadableException {
        return Entity.parse(json.getBytes(UTF_8));
    }
}
