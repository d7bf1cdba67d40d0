package io.furrow.model.field;

import java.io.IOException;
import java.io.InputStream;
import java.time.Instant;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FieldVersionTest {
    private static final long SPRING = Instant.parse("2026-03-01T00:00:00.250Z").toEpochMilli();

    @Test
    void isWrittenAndReadAsItsGoldenJson() throws Exception {
        FieldVersion north = new FieldVersion(
                "north",
                SPRING,
                object("{'type':'Polygon','coordinates':[[[10,50.10],[20,50],[20,60],[10,50.10]]]}"),
                object("{'name':'Behind the barn','Domain':'canary','crop':'maize'}"));
        FieldVersion ended = new FieldVersion("7", 0, null, object("{}"));

        assertThat(new String(north.toBytes(), UTF_8)).isEqualTo(golden("north"));
        assertThat(new String(ended.toBytes(), UTF_8)).isEqualTo(golden("ended"));
        assertThat(read(golden("north"))).isEqualTo(north);
        assertThat(read(golden("ended"))).isEqualTo(ended);
    }

    @Test
    void hasAKeyOfItsIdAndItsTime() throws Exception {
        assertThat(read(golden("north")).key()).isEqualTo("north@2026-03-01T00:00:00.250Z");
        assertThat(read(golden("ended")).key()).isEqualTo("7@1970-01-01T00:00:00.000Z");
    }

    @Test
    void parsesAKeyWithAnyFormatOfTime() throws Exception {
        assertThat(FieldVersion.Key.parse("a@b@2026-03-01T00:00:00.250Z")).hasToString("a@b@2026-03-01T00:00:00.250Z");
        assertThat(FieldVersion.Key.parse("north@2026-03-01T00:00:00Z")).hasToString("north@2026-03-01T00:00:00.000Z");
        assertThat(FieldVersion.Key.parse("north@2026-03-01T01:00:00+01:00"))
                .hasToString("north@2026-03-01T00:00:00.000Z");
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "north", "@2026-03-01T00:00:00Z", "north@", "north@spring", "north@1700000000000"})
    void rejectsInvalidKeys(String key) {
        assertThatThrownBy(() -> FieldVersion.Key.parse(key))
                .isInstanceOfSatisfying(
                        UnreadableException.class, e -> assertThat(e.reason()).isEqualTo(Reason.NOT_AN_EVENT));
    }

    @Test
    void readsItsNameAndDomain() throws Exception {
        FieldVersion north = read(golden("north"));
        FieldVersion ended = read(golden("ended"));

        assertThat(north.name()).isEqualTo("Behind the barn");
        assertThat(north.domain()).isEqualTo("canary");
        assertThat(north.isEnd()).isFalse();
        assertThat(ended.name()).isEmpty();
        assertThat(ended.domain()).isEmpty();
        assertThat(ended.isEnd()).isTrue();
    }

    @Test
    void acceptsWholeNumbersAsIdsAndAnyOffsetOfTime() throws Exception {
        FieldVersion version = read(
                "{'type':'Feature','id':7,'geometry':null,'properties':{'validFrom':'2026-03-01T02:00:00.25+02:00'}}");

        assertThat(version).isEqualTo(new FieldVersion("7", SPRING, null, object("{}")));
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {"id"                                                                   | NOT_JSON     | ''
            7                                                                       | NOT_AN_EVENT | not a GeoJSON Feature
            {'type':'FeatureCollection','features':[]}                              | NOT_AN_EVENT | not a GeoJSON Feature
            {'type':'Feature','geometry':null,'properties':{'validFrom':'T'}}       | NOT_AN_EVENT | 'id'
            {'type':'Feature','id':1.5,'geometry':null,'properties':{'validFrom':'T'}} | NOT_AN_EVENT | 'id'
            {'type':'Feature','id':'my field','geometry':null,'properties':{'validFrom':'T'}} | NOT_AN_EVENT | 'id'
            {'type':'Feature','id':'f','geometry':null}                             | NOT_AN_EVENT | 'properties'
            {'type':'Feature','id':'f','geometry':null,'properties':null}           | NOT_AN_EVENT | 'properties'
            {'type':'Feature','id':'f','geometry':null,'properties':{}}             | NOT_AN_EVENT | 'validFrom'
            {'type':'Feature','id':'f','geometry':null,'properties':{'validFrom':1}} | NOT_AN_EVENT | 'validFrom'
            {'type':'Feature','id':'f','geometry':null,'properties':{'validFrom':'spring'}} | NOT_AN_EVENT | not a time
            {'type':'Feature','id':'f','geometry':null,'properties':{'validFrom':'2026-03-01'}} | NOT_AN_EVENT | not a time
            {'type':'Feature','id':'f','properties':{'validFrom':'T'}}              | NOT_AN_EVENT | 'geometry'
            {'type':'Feature','id':'f','geometry':{'type':'Point'},'properties':{'validFrom':'T'}} | NOT_AN_EVENT | Polygon
            {'type':'Feature','id':'f','geometry':[],'properties':{'validFrom':'T'}} | NOT_AN_EVENT | Polygon
            """)
    void rejectsInvalidFields(String json, Reason reason, String message) {
        assertThatThrownBy(() -> read(json.replace("'T'", "'2026-03-01T00:00:00Z'")))
                .isInstanceOfSatisfying(
                        UnreadableException.class, e -> assertThat(e.reason()).isEqualTo(reason))
                .hasMessageContaining(message.replace("''", ""));
    }

    private static FieldVersion read(String json) throws UnreadableException {
        return FieldVersion.read(json.replace('\'', '"').getBytes(UTF_8));
    }

    private static ObjectNode object(String json) throws UnreadableException {
        return (ObjectNode) NgsiJson.read(json.replace('\'', '"').getBytes(UTF_8));
    }

    private static String golden(String name) throws IOException {
        try (InputStream json = FieldVersionTest.class.getResourceAsStream("/golden/field/" + name + ".json")) {
            return new String(json.readAllBytes(), UTF_8).strip();
        }
    }
}
