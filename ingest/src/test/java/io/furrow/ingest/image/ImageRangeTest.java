package io.furrow.ingest.image;

import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ImageRangeTest {
    private static final Set<String> IMAGE = Set.of("Image");

    @Test
    void changesNoByteButTheImage() throws Exception {
        byte[] entity = utf8(
                "{ \"id\":\"cämera\",\"type\" : \"Camera\", \"Image\":{\"type\":\"String\",\"value\": \"QUJD\" ,\"metadata\":{}},\n"
                        + " \"Note\":{\"value\":\"\\u00e4 QUJD\",\"n\":1.50}}");

        List<ImageRange> spans = ImageRange.find(entity, IMAGE);

        assertThat(spans).hasSize(1);
        assertThat(text(spans.get(0).text(entity))).isEqualTo("QUJD");
        assertThat(text(ImageRange.replace(entity, spans, List.of(utf8("{\"url\":\"x\"}")))))
                .isEqualTo("{ \"id\":\"cämera\",\"type\" : \"Camera\", \"Image\":{\"type\":\"String\",\"value\": "
                        + "{\"url\":\"x\"} ,\"metadata\":{}},\n \"Note\":{\"value\":\"\\u00e4 QUJD\",\"n\":1.50}}");
    }

    @Test
    void findsEachOfSeveralImages() throws Exception {
        byte[] entity = utf8("{\"id\":\"r\",\"Left\":{\"value\":\"AA\"},\"n\":{\"value\":[1,{\"Left\":2}]},"
                + "\"Right\":{\"metadata\":{\"value\":{\"value\":\"no\"}},\"value\":\"BB\"}}");
        Set<String> both = new LinkedHashSet<>(List.of("Right", "Left"));

        List<ImageRange> spans = ImageRange.find(entity, both);

        assertThat(spans).extracting(ImageRange::attribute).containsExactly("Left", "Right");
        assertThat(text(ImageRange.replace(entity, spans, List.of(utf8("1"), utf8("2")))))
                .contains("\"Left\":{\"value\":1}")
                .endsWith("\"value\":2}}");
    }

    @Test
    void understandsTheEscapesOfJson() throws Exception {
        byte[] entity = utf8("{\"id\":\"c\",\"Im\\u0061ge\":{\"value\":\"Q\\/J\\u0043\\n\\\\\\\"\"}}");

        assertThat(ImageRange.possible(entity, ImageRange.quoted(IMAGE))).isTrue();
        assertThat(text(ImageRange.find(entity, IMAGE).get(0).text(entity))).isEqualTo("Q/JC\n\\\"");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '^', textBlock = """
                    no such attribute    | {"id":"c","Temperature":{"value":"QUJD"}}
                    null                 | {"id":"c","Image":{"value":null}}
                    a number             | {"id":"c","Image":{"value":7}}
                    a reference          | {"id":"c","Image":{"value":{"url":"file:/x","sha256":"00"}}}
                    empty                | {"id":"c","Image":{"value":""}}
                    blank                | {"id":"c","Image":{"value":" \\n"}}
                    an address           | {"id":"c","Image":{"value":"https://farm.example/latest.png"}}
                    a file of the device | {"id":"c","Image":{"value":"file:/tmp/x.png"}}
                    in another attribute | {"id":"c","Other":{"value":{"Image":{"value":"QUJD"}}}}
                    """)
    void leavesAloneWhatHoldsNoImage(String what, String entity) throws Exception {
        assertThat(ImageRange.find(utf8(entity), IMAGE)).isEmpty();
    }

    @Test
    void refusesWhatIsNoJson() {
        assertThatThrownBy(() -> ImageRange.find(utf8("{\"Image\":{\"value\":\"QUJD"), IMAGE))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("no end");
        assertThatThrownBy(() -> ImageRange.find(utf8("{\"Image\":{\"value\":\"QUJD\"}"), IMAGE))
                .isInstanceOf(UnreadableException.class);
    }

    @Test
    void passesOverAnEventThatNamesNoImageAtAGlance() {
        byte[] entity =
                utf8("{\"id\":\"t\",\"Temperature\":{\"value\":1,\"metadata\":{}},\"Images\":{\"value\":\"\"}}");

        assertThat(ImageRange.possible(entity, ImageRange.quoted(IMAGE))).isFalse();
        assertThat(ImageRange.possible(entity, ImageRange.quoted(Set.of("Images"))))
                .isTrue();
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }

    private static String text(byte[] utf8) {
        return new String(utf8, UTF_8);
    }
}
