package io.furrow.cli.option;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

class JsonPathTemplateTest {
    private static final String MISSIONS = """
            [{"mission": "weeding", "deviceCount": 5, "status": {"state": "running", "since": null}, "tags": ["a", "b c"]},
             {"mission": "mowing", "deviceCount": 12, "status": {"state": "stopped"}, "a.b": true}]
            """;

    @ParameterizedTest
    @CsvSource(delimiter = '|', ignoreLeadingAndTrailingWhitespace = false, textBlock = """
            {.items[*].mission}|weeding mowing
            {[*].mission}|weeding mowing
            {$.items[*].mission}|weeding mowing
            { .items[0].status.state }|running
            {.items[-1].mission}|mowing
            {.items[7].mission}|
            {.items[0].nosuch.member}|
            first: {.items[0].mission}.|first: weeding.
            {.items[0].status}|{"state":"running","since":null}
            {.items[0].tags}|["a","b c"]
            {.items[0].tags[*]}|a b c
            {.items[1]['a.b']}|true
            {..state}|running stopped
            {.items[*].status.*}|running null stopped
            {.items[?(@.status.state=="running")].mission}|weeding
            {.items[?(@.status.state != 'running')].mission}|mowing
            {.items[?(@.deviceCount > 5)].mission}|mowing
            {.items[?(@.deviceCount<=12)].mission}|weeding mowing
            {.items[?(@.tags)].mission}|weeding
            {range .items[*]}{.mission}={.deviceCount}{","}{end}|weeding=5,mowing=12,
            {range .items[*]}{.mission}:{range .tags[*]}{@};{end} {end}|weeding:a;b c; mowing:\s
            """)
    void findsValues(String template, String values) throws Exception {
        String found = JsonPathTemplate.parse(template).print(NgsiJson.read(MISSIONS.getBytes(UTF_8)));

        assertThat(found).isEqualTo(values == null ? "" : values);
    }

    @Test
    void endsLinesAndReadsObjects() throws Exception {
        JsonPathTemplate template = JsonPathTemplate.parse("{.mission}{\"\\t\"}{.items[*].a}{'\\n'}");

        assertThat(template.print(NgsiJson.read("{\"mission\":\"weeding\",\"items\":[{\"a\":1}]}".getBytes(UTF_8))))
                .isEqualTo("weeding\t1\n");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            .mission                   | no expression in braces
            {.mission                  | '{' is not closed at character 1
            {.mission[}                | cannot be read at character 9
            {.a[?(@.b===1)]}           | cannot be read at character 3
            {end}                      | no range is open at character 1
            {range .items[*]}{.mission} | {end} of a range is missing
            """)
    void rejectsWhatIsNoTemplate(String template, String fault) {
        assertThatIllegalArgumentException()
                .isThrownBy(() -> JsonPathTemplate.parse(template))
                .withMessageContaining(fault)
                .withMessageContaining("is no JSONPath");
    }
}
