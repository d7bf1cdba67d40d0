package io.furrow.cli.compare;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static io.furrow.cli.compare.ResultRecords.T0;
import static io.furrow.cli.compare.ResultRecords.average;
import static io.furrow.cli.compare.ResultRecords.encounter;
import static io.furrow.cli.compare.ResultRecords.entered;
import static io.furrow.cli.compare.ResultRecords.left;
import static io.furrow.cli.compare.ResultRecords.side;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ComparisonFormsTest {
    private static final Comparison DIFFERENT = Comparison.of(
            side(
                    "weeding.0a1b2c3d",
                    encounter("xy", "ended", 2, 0, 10),
                    encounter("<&", "ended", 2, 20, 30),
                    average("f", 0, 21.5, "robust", "x"),
                    average("f", 10, 22, "robust"),
                    left("x", "f", 1, 9)),
            side(
                    "live",
                    encounter("xy", "ended", 2.25, 0, 7),
                    average("f", 0, 21.25, "unverified"),
                    average("f", 10, 22, "robust"),
                    left("x", "f", 1, 9),
                    entered("z", "f", 61)),
            TimeRange.ALL);

    @Test
    void showsWhatDiffersAsATable() {
        assertThat(new ComparisonTable(40).lines(DIFFERENT))
                .containsExactly(
                        "A  weeding.0a1b2c3d, epoch 0",
                        "B  live",
                        "",
                        "ENCOUNTERS  0 same, 1 changed, 1 only in A, 0 only in B",
                        "  changed    2026-05-01T01:46:40Z  10 s          x – y  closest 2 → 2.25 (+0.25), end 3 s earlier",
                        "  only in A  2026-05-01T01:47:00Z  10 s          < – &  closest 2 m",
                        "",
                        "AVERAGES  1 same, 1 changed, 0 only in A, 0 only in B",
                        "  changed    2026-05-01T01:46:40Z  10 s          f Temperature  mean 21.5 → 21.25 (−0.25), suspects x → none, "
                                + "quality robust → unverified",
                        "",
                        "STAYS  1 same, 0 changed, 0 only in A, 1 only in B",
                        "  only in B  2026-05-01T01:47:41Z  open          z in f",
                        "",
                        "A and B differ.");
    }

    @Test
    void reportsHowManyLinesItLeavesOut() {
        assertThat(new ComparisonTable(1).lines(DIFFERENT))
                .contains("  … and 1 more; --limit shows more")
                .noneMatch(line -> line.contains("< – &"));
    }

    @Test
    void showsWhatDiffersAsJson() {
        JsonNode json = ComparisonJson.of(DIFFERENT);

        assertThat(json.at("/same").asBoolean()).isFalse();
        assertThat(json.at("/stays/same").asInt()).isEqualTo(1);
        assertThat(json.at("/encounters/differences/0").toString())
                .isEqualTo(
                        "{\"verdict\":\"changed\",\"subject\":\"x – y\",\"a\":{\"start\":\"%s\",\"end\":\"%s\",\"closest\":2.0},\"b\":{\"start\":\"%s\",\"end\":\"%s\",\"closest\":2.25},\"changes\":[\"closest\",\"end\"]}"
                                .formatted(
                                        "2026-05-01T01:46:40Z",
                                        "2026-05-01T01:46:50Z",
                                        "2026-05-01T01:46:40Z",
                                        "2026-05-01T01:46:47Z"));
        assertThat(json.at("/encounters/differences/1/b").isNull()).isTrue();
        assertThat(json.at("/averages/differences/0/b/suspects").isEmpty()).isTrue();
    }

    @Test
    void drawsBothSidesOverTimeInAPageThatLoadsNothing() throws Exception {
        String html = ComparisonHtml.of(DIFFERENT);

        assertThat(html).contains("uPlot=function", "Copyright").doesNotContain("{{", "<link", " src=", "import(");
        JsonNode encounters = data(html).at("/kinds/0");
        assertThat(encounters.at("/lanes").findValuesAsText("name")).containsExactly("< – &", "x – y");
        assertThat(encounters.at("/lanes/0/matches/0/b").isNull()).isTrue();
        assertThat(encounters.at("/lanes/1/matches/0/text").asText())
                .isEqualTo("2026-05-01T01:46:40Z, 10 s, changed: closest 2 → 2.25 (+0.25), end 3 s earlier");
        assertThat(data(html).at("/kinds/1/lanes/0/matches/0/b/mean").asDouble())
                .isEqualTo(21.25);
        assertThat(data(html).at("/kinds/2/lanes/0/matches/0/b").has("end")).isFalse();
        assertThat(data(html).at("/from").asLong()).isEqualTo(T0);
        assertThat(data(html).at("/to").asLong()).isEqualTo(T0 + 61_000);
    }

    @Test
    void drawsWhereNothingWasFound() throws Exception {
        JsonNode data = data(ComparisonHtml.of(Comparison.of(side("a"), side("</script>"), TimeRange.ALL)));

        assertThat(data.at("/same").asBoolean()).isTrue();
        assertThat(data.at("/b").asText()).isEqualTo("</script>");
        assertThat(data.at("/kinds")).isEmpty();
    }

    private static JsonNode data(String html) throws Exception {
        String before = "<script id=\"data\" type=\"application/json\">";
        int begin = html.indexOf(before) + before.length();
        return NgsiJson.read(
                html.substring(begin, html.indexOf("</script>", begin)).getBytes(UTF_8));
    }
}
