package io.furrow.ingest.catalog;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.SlicedEntity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class CatalogEntryTest {
    private static final long T = Reports.TIME;

    @Test
    void profilesTypesUnitsRangesAndRates() throws Exception {
        CatalogEntry entry = CatalogEntry.of(Reports.thermometer("t1", "weeding", T, 20))
                .andEntities(1)
                .plus(CatalogEntry.of(Reports.thermometer("t1", "weeding", T + 1_000, -3.5)))
                .plus(CatalogEntry.of(Reports.thermometer("t1", "weeding", T + 4_000, 31)));

        assertThat(new String(entry.toBytes(null), UTF_8))
                .isEqualTo(
                        "{\"service\":\"farm\",\"domain\":\"north\",\"mission\":\"weeding\",\"type\":\"Thermometer\","
                                + "\"entities\":1,\"events\":3,\"bytes\":" + entry.bytes()
                                + ",\"images\":0,\"imageBytes\":0,\"first\":\"2023-11-14T22:13:20Z\","
                                + "\"last\":\"2023-11-14T22:13:24Z\",\"rate\":0.5,\"attributes\":{\"Temperature\":{"
                                + "\"type\":\"Float\",\"unit\":\"CEL\",\"kind\":\"number\",\"values\":3,\"min\":-3.5,\"max\":31.0,"
                                + "\"first\":\"2023-11-14T22:13:20Z\",\"last\":\"2023-11-14T22:13:24Z\",\"rate\":0.5}}}");
        assertThat(entry.key()).isEqualTo("farm|north|weeding|Thermometer");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '^', textBlock = """
                    {"type":"Float","value":1}                                               | number    | 1
                    {"type":"Text","value":"1"}                                              | text      | 0
                    {"type":"Boolean","value":true}                                          | boolean   | 0
                    {"type":"geo:json","value":{"type":"Point","coordinates":[1,2]}}         | structure | 0
                    {"type":"StructuredValue","value":[1]}                                   | structure | 0
                    {"type":"String","value":{"url":"file:/x","sha256":"0","bytes":7}}       | image     | 0
                    """)
    void tellsKindsOfValuesApart(String attribute, String kind, long numbers) throws Exception {
        byte[] entity = "{\"id\":\"t1\",\"a\":%s}".formatted(attribute).getBytes(UTF_8);
        AttributeProfile profile = AttributeProfile.of(
                        SlicedEntity.parse(entity).attributes().get(0), T)
                .orElseThrow();

        assertThat(profile.kind()).isEqualTo(kind);
        assertThat(profile.numbers()).isEqualTo(numbers);
    }

    @Test
    void countsImagesAndTheirBytesAndNoNulls() throws Exception {
        CatalogEntry entry = CatalogEntry.of(Reports.of(
                "c1",
                "m",
                T,
                "{\"id\":\"c1\",\"Image\":{\"value\":{\"url\":\"file:/x\",\"sha256\":\"0\",\"bytes\":700}},"
                        + "\"Left\":{\"value\":null},\"dateModified\":{\"value\":\"2023-11-14T22:13:20Z\"}}"));

        assertThat(entry.images()).isEqualTo(1);
        assertThat(entry.imageBytes()).isEqualTo(700);
        assertThat(entry.type()).isEqualTo("Thing");
        assertThat(entry.attributes()).containsOnlyKeys("Image");
    }

    @Test
    void addsUpToTheSameInAnyOrder() throws Exception {
        Random random = new Random(8);
        List<CatalogEntry> entries = new ArrayList<>();
        for (int i = 0; i < 200; i++) {
            long time = T + random.nextInt(50);
            entries.add(
                    i % 5 == 0
                            ? CatalogEntry.of(Reports.of(
                                    "x",
                                    "m",
                                    time,
                                    "{\"id\":\"x\",\"type\":\"Thermometer\",\"Temperature\":{\"value\":\"hot\"}}"))
                            : CatalogEntry.of(Reports.thermometer("t" + i, "m", time, random.nextInt(40))));
        }
        CatalogEntry expected = sum(entries);

        for (int i = 0; i < 20; i++) {
            Collections.shuffle(entries, random);
            CatalogEntry half = sum(entries.subList(0, 77)).plus(sum(entries.subList(77, 200)));
            assertThat(half).isEqualTo(expected);
        }
        assertThat(expected.attributes().get("Temperature").kind()).isEqualTo("mixed");
    }

    @Test
    void holdsNoMoreAttributesThanItMay() throws Exception {
        CatalogEntry entry = CatalogEntry.of(Reports.thermometer("t1", "m", T, 1));
        for (int i = 0; i < 1_200; i++) {
            entry = entry.plus(CatalogEntry.of(
                    Reports.of("t1", "m", T, "{\"id\":\"t1\",\"type\":\"Thermometer\",\"a" + i + "\":{\"value\":1}}")));
        }

        assertThat(entry.attributes()).hasSize(CatalogEntry.MAX_ATTRIBUTES).containsKey("Temperature");
        assertThat(entry.events()).isEqualTo(1_201);
    }

    @Test
    void namesTheNewestTypeAndUnitOfAnAttribute() throws Exception {
        CatalogEntry celsius = CatalogEntry.of(Reports.thermometer("t1", "m", T + 1, 20));
        CatalogEntry fahrenheit = CatalogEntry.of(
                Reports.of(
                        "t1",
                        "m",
                        T,
                        "{\"id\":\"t1\",\"Temperature\":{\"type\":\"Number\",\"value\":68,\"metadata\":{\"unitCode\":{\"value\":\"FAH\"}}}}"));

        for (CatalogEntry both : List.of(celsius.plus(fahrenheit), fahrenheit.plus(celsius))) {
            AttributeProfile temperature = both.attributes().get("Temperature");
            assertThat(temperature.type()).isEqualTo("Float");
            assertThat(temperature.unit()).isEqualTo("CEL");
        }
    }

    private static CatalogEntry sum(List<CatalogEntry> entries) {
        return entries.stream().reduce(CatalogEntry::plus).orElseThrow();
    }
}
