package io.furrow.model.ngsi;

import java.util.Map;
import java.util.Random;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatExceptionOfType;

class SlicedEntityTest {
    private static final String STATION = """
            {"id":"s-ñ","Wind":{"type":"Number","value":1.50e1,"metadata":{"unitCode":{"type":"Text","value":"KMH"}}},
             "type":"Station","Depth":{"type":"Number","value":7,"metadata":{"unit":{"value":5},"at":{"value":[1]}}},"Note":{"type":"Text","value":"caf\\u00e9 😀 \\"}]","metadata":{}},
             "Rain" : {"value": {"sum":0.10,"parts":[1,{"a":2}]}},"Off":{"value":null}}
            """;

    @Test
    void keepsNormalizedAttributesAsReported() throws UnreadableException {
        Map<String, String> attributes = jsonByName(SlicedEntity.parse(bytes(STATION)));

        assertThat(attributes)
                .containsOnlyKeys("Wind", "Depth", "Note", "Rain", "Off")
                .containsEntry(
                        "Wind",
                        "{\"type\":\"Number\",\"value\":1.50e1,\"metadata\":{\"unitCode\":{\"type\":\"Text\",\"value\":\"KMH\"}}}")
                .containsEntry("Note", "{\"type\":\"Text\",\"value\":\"caf\\u00e9 😀 \\\"}]\",\"metadata\":{}}");
    }

    @Test
    void normalizesOtherAttributes() throws UnreadableException {
        assertThat(jsonByName(SlicedEntity.parse(bytes(STATION))))
                .containsEntry(
                        "Rain",
                        "{\"type\":\"StructuredValue\",\"value\":{\"sum\":0.10,\"parts\":[1,{\"a\":2}]},\"metadata\":{}}")
                .containsEntry("Off", "{\"type\":\"None\",\"value\":null,\"metadata\":{}}");
    }

    @Test
    void readsAndRejectsLikeTheWholeEntity() throws UnreadableException {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        byte[] characters = bytes("{}[]\":,\\u0d8eE-1 ");
        int read = 0;
        for (int i = 0; i < 20_000; i++) {
            byte[] damaged = bytes(STATION);
            for (int changes = 1 + random.nextInt(2); changes > 0; changes--) {
                damaged[random.nextInt(damaged.length)] = characters[random.nextInt(characters.length)];
            }
            String round = "seed %d, round %d: %s".formatted(seed, i, new String(damaged, UTF_8));

            Entity whole = wholeOrNull(damaged);
            if (whole == null) {
                assertThatExceptionOfType(UnreadableException.class)
                        .as(round)
                        .isThrownBy(() -> SlicedEntity.parse(damaged));
            } else {
                SlicedEntity sliced = SlicedEntity.parse(damaged);
                assertThat(sliced.type()).as(round).isEqualTo(whole.type());
                assertThat(sliced.attributes())
                        .as(round)
                        .extracting(SlicedEntity.Slice::name)
                        .containsExactlyElementsOf(whole.attributes().stream()
                                .map(Map.Entry::getKey)
                                .toList());
                for (SlicedEntity.Slice slice : sliced.attributes()) {
                    assertAlike(slice, whole.json().get(slice.name()), round);
                }
                read++;
            }
        }
        assertThat(read).isGreaterThan(1000);
    }

    private static void assertAlike(SlicedEntity.Slice slice, JsonNode attribute, String round)
            throws UnreadableException {
        JsonNode value = attribute.get("value");
        JsonNode code = attribute.at("/metadata/unitCode/value");
        String unit = code.isTextual()
                ? code.textValue()
                : attribute.at("/metadata/unit/value").asText("");
        assertThat(NgsiJson.read(bytes(slice.json()))).as(round).isEqualTo(attribute);
        assertThat(slice.type()).as(round).isEqualTo(attribute.get("type").textValue());
        assertThat(slice.unit()).as(round).isEqualTo(unit);
        assertThat(slice.value()).as(round).isEqualTo(value.asToken());
        Double number = value.isNumber() ? value.doubleValue() : Double.NaN;
        assertThat(slice.number()).as(round).isEqualTo(number);
        assertThat(slice.tree()).as(round).isEqualTo(value);
    }

    private static Map<String, String> jsonByName(SlicedEntity entity) {
        return entity.attributes().stream()
                .collect(Collectors.toMap(SlicedEntity.Slice::name, SlicedEntity.Slice::json));
    }

    private static Entity wholeOrNull(byte[] json) {
        try {
            return Entity.parse(json);
        } catch (UnreadableException e) {
            return null;
        }
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }
}
