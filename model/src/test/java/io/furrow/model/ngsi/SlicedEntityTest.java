package io.furrow.model.ngsi;

import java.util.Map;
import java.util.Random;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatExceptionOfType;

class SlicedEntityTest {
    private static final String STATION = """
            {"id":"s-ñ","Wind":{"type":"Number","value":1.50e1,"metadata":{"unitCode":{"type":"Text","value":"KMH"}}},
             "type":"Station","Note":{"type":"Text","value":"caf\\u00e9 😀 \\"}]","metadata":{}},
             "Rain" : {"value": {"sum":0.10,"parts":[1,{"a":2}]}},"Off":{"value":null}}
            """;

    @Test
    void holdsWhatIsNormalizedAsItWasReported() throws UnreadableException {
        Map<String, String> attributes = SlicedEntity.parse(bytes(STATION)).attributes();

        assertThat(attributes)
                .containsOnlyKeys("Wind", "Note", "Rain", "Off")
                .containsEntry(
                        "Wind",
                        "{\"type\":\"Number\",\"value\":1.50e1,\"metadata\":{\"unitCode\":{\"type\":\"Text\",\"value\":\"KMH\"}}}")
                .containsEntry("Note", "{\"type\":\"Text\",\"value\":\"caf\\u00e9 😀 \\\"}]\",\"metadata\":{}}");
    }

    @Test
    void composesWhatIsNot() throws UnreadableException {
        assertThat(SlicedEntity.parse(bytes(STATION)).attributes())
                .containsEntry(
                        "Rain",
                        "{\"type\":\"StructuredValue\",\"value\":{\"sum\":0.10,\"parts\":[1,{\"a\":2}]},\"metadata\":{}}")
                .containsEntry("Off", "{\"type\":\"None\",\"value\":null,\"metadata\":{}}");
    }

    @Test
    void readsAndRefusesAsTheWholeEntityIs() throws UnreadableException {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        byte[] signs = bytes("{}[]\":,\\u0d8eE-1 ");
        int read = 0;
        for (int i = 0; i < 20_000; i++) {
            byte[] damaged = bytes(STATION);
            for (int changes = 1 + random.nextInt(2); changes > 0; changes--) {
                damaged[random.nextInt(damaged.length)] = signs[random.nextInt(signs.length)];
            }
            String round = "seed %d, round %d: %s".formatted(seed, i, new String(damaged, UTF_8));

            Entity whole = wholeOrNull(damaged);
            if (whole == null) {
                assertThatExceptionOfType(UnreadableException.class)
                        .as(round)
                        .isThrownBy(() -> SlicedEntity.parse(damaged));
            } else {
                SlicedEntity sliced = SlicedEntity.parse(damaged);
                assertThat(sliced.entity().json()).as(round).isEqualTo(whole.json());
                for (Map.Entry<String, JsonNode> attribute : whole.attributes()) {
                    assertThat(NgsiJson.read(bytes(sliced.attributes().get(attribute.getKey()))))
                            .as(round)
                            .isEqualTo(attribute.getValue());
                }
                assertThat(sliced.attributes())
                        .as(round)
                        .hasSize(whole.attributes().size());
                read++;
            }
        }
        assertThat(read).isGreaterThan(1000);
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
