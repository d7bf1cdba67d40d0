package io.furrow.model.ngsi;

import java.nio.charset.StandardCharsets;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatExceptionOfType;

class EntityExcerptTest {
    private static final String CAMERA = """
            {"id":"c","Image":{"type":"Text","value":"aGVsbG8=","metadata":{"deep":{"type":"x","value":[1,{"a":2}]}}},
             "type":"Camera","Mission":{"type":"String","value":"m","metadata":{}},
             "location":{"type":"geo:json","value":{"type":"Point","coordinates":[-3.7,40.4]},"metadata":{}}}
            """;

    @Test
    void holdsIdTypeAndTheWantedAttributesAsTheWholeEntityDoes() throws UnreadableException {
        Entity whole = Entity.parse(bytes(CAMERA));
        Entity excerpt = Entity.parse(bytes(CAMERA), Set.of("Mission", "location", "absent"));

        assertThat(excerpt.id()).isEqualTo("c");
        assertThat(excerpt.type()).isEqualTo("Camera");
        assertThat(excerpt.json().fieldNames()).toIterable().containsExactly("id", "type", "Mission", "location");
        assertThat(excerpt.json().get("location")).isEqualTo(whole.json().get("location"));
        assertThat(PositionReading.of(excerpt)).isEqualTo(PositionReading.of(whole));
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "``                                                  | not-json",
                "`{\"id\":\"c\"} {}`                                 | not-json",
                "`{\"id\":\"c\",\"x\":{\"value\":1}`                 | not-json",
                "`{\"id\":\"c\",\"x\":{\"value\":\"a}}`               | not-json",
                "`{\"id\":\"c\",\"id\":\"d\"}`                       | not-json",
                "`{\"schema\":{\"type\":\"int32\"},\"payload\":7}`   | not-an-entity",
                "`{\"schema\":{\"type\":\"int32\"}}`                 | not-an-entity",
                "`[1]`                                               | not-an-entity",
                "`{\"id\":7}`                                        | not-an-entity",
                "`{\"id\":\"c\",\"Mission\":{\"type\":\"x\"}}`       | not-an-entity"
            })
    void refusesWhatIsNoEntity(String body, String reason) {
        assertThatExceptionOfType(UnreadableException.class)
                .isThrownBy(() -> Entity.parse(bytes(body), Set.of("Mission")))
                .satisfies(refusal -> assertThat(refusal.reason().code()).isEqualTo(reason));
    }

    @Test
    void refusesWhatIsNestedTooDeepInAnAttributeThatNobodyWants() {
        String deep = "{\"id\":\"c\",\"x\":{\"value\":" + "[".repeat(100) + "]".repeat(100) + "}}";

        assertThatExceptionOfType(UnreadableException.class)
                .isThrownBy(() -> Entity.parse(bytes(deep), Set.of()))
                .satisfies(refusal -> assertThat(refusal.reason()).isEqualTo(Reason.TOO_DEEP));
    }

    private static byte[] bytes(String text) {
        return text.getBytes(StandardCharsets.UTF_8);
    }
}
