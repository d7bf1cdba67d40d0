package io.furrow.model.ngsi;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Random;
import java.util.Set;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.model.position.PositionReading;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatExceptionOfType;

class PartialEntityReaderTest {
    private static final String CAMERA = """
            {"id":"c","Image":{"type":"Text","value":"aGVsbG8=","metadata":{"deep":{"type":"x","value":[1,{"a":2}]}}},
             "type":"Camera","Mission":{"type":"String","value":"m","metadata":{}},
             "location":{"type":"geo:json","value":{"type":"Point","coordinates":[-3.7,40.4]},"metadata":{}}}
            """;

    @Test
    void hasIdTypeAndTheDesiredAttributesOfTheWholeEntity() throws UnreadableException {
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
    void rejectsInvalidEntities(String body, String reason) {
        assertThatExceptionOfType(UnreadableException.class)
                .isThrownBy(() -> Entity.parse(bytes(body), Set.of("Mission")))
                .satisfies(rejection -> assertThat(rejection.reason().code()).isEqualTo(reason));
    }

    @Test
    void rejectsTooDeepNestingInASkippedAttribute() {
        String deep = "{\"id\":\"c\",\"x\":{\"value\":" + "[".repeat(100) + "]".repeat(100) + "}}";

        assertThatExceptionOfType(UnreadableException.class)
                .isThrownBy(() -> Entity.parse(bytes(deep), Set.of()))
                .satisfies(rejection -> assertThat(rejection.reason()).isEqualTo(Reason.TOO_DEEP));
    }

    static Stream<String> attributes() {
        return Stream.of(
                "{}",
                "{\"type\":\"Text\"}",
                "{\"metadata\":{\"value\":1}}",
                "{\"value\":\"half a pair \\ud800\"}",
                "{\"value\":\"a pair \\ud83d\\ude00\"}",
                "{\"value\":{\"\\udc00\":1}}",
                "{\"value\":1e1001}",
                "{\"value\":[1E-1001]}",
                "{\"value\":1e99999999999}",
                "{\"value\":1e3}",
                "{\"value\":" + "1".repeat(1001) + "}",
                "{\"value\":0." + "1".repeat(1001) + "}",
                "{\"value\":1,\"value\":2}",
                "{\"value\":{\"a\":1,\"a\":2}}",
                "{\"value\":" + "[".repeat(62) + "]".repeat(62) + "}",
                "{\"value\":" + "[".repeat(63) + "]".repeat(63) + "}",
                "{\"value\":\"" + "x".repeat(NgsiJson.MAX_STRING + 1) + "\"}");
    }

    @ParameterizedTest(name = "{index}") // the text may have megabytes
    @MethodSource("attributes")
    void rejectsInASkippedAttributeWhatAWholeReadRejects(String attribute) {
        byte[] entity = bytes("{\"id\":\"c\",\"x\":" + attribute + "}");

        assertThat(rejection(() -> Entity.parse(entity, Set.of("Mission"))))
                .isEqualTo(rejection(() -> Entity.parse(entity)));
    }

    @Test
    void rejectsRandomDamageLikeAWholeRead() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        byte[] characters = bytes("{}[]\":,\\u0d8eE-1 \u00e9");
        for (int i = 0; i < 20_000; i++) {
            byte[] damaged = bytes(CAMERA);
            for (int changes = 1 + random.nextInt(2); changes > 0; changes--) {
                damaged[random.nextInt(damaged.length)] = characters[random.nextInt(characters.length)];
            }

            String whole = rejection(() -> Entity.parse(damaged));
            assertThat(rejection(() -> Entity.parse(damaged, Set.of("Mission"))).isEmpty())
                    .as("seed %d, round %d: %s, as a whole %s", seed, i, new String(damaged, UTF_8), whole)
                    .isEqualTo(whole.isEmpty());
        }
    }

    /** Returns the reason; empty if there is none. */
    private static String rejection(NgsiJson.Reading<Entity> reading) {
        try {
            reading.read();
            return "";
        } catch (UnreadableException e) {
            return e.reason().code();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }
}
