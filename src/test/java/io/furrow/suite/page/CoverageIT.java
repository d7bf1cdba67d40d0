package io.furrow.suite.page;

import java.io.ByteArrayOutputStream;
import java.time.Instant;
import java.util.Arrays;
import java.util.Base64;
import java.util.List;
import java.util.stream.Collectors;

import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The worked area on the map: live, in a replay and of a mission. */
@Tag("full")
class CoverageIT extends StubbedPage {
    private static final long START = Instant.parse("2026-01-01T03:04:30Z").toEpochMilli();

    /** Longitude and latitude of the field. */
    private static final double[] CORNER = {-3.482, 40.312};

    @BeforeEach
    void start() {
        farm.hasField("barn", "farm", CORNER[0], CORNER[1]);
    }

    @Test
    void showsWhereAndHowMuchWasWorked() {
        long now = System.currentTimeMillis();
        farm.answers(
                        "/api/history/data.coverage",
                        records(figures("weeding", "", now, 0.31), figures("weeding", "r1", now, 0.2)))
                .answers(
                        "/api/history/data.coverage.layer",
                        records(layer("weeding", now, run(10, 0), run(50, 1), run(10, 2), run(20, 3), run(10, 1))));
        FarmPage page = farm.open("#/map?table=1", 1440, 900);
        page.until(() -> cells(page).stream().allMatch(each -> each > 100));
        List<Integer> drawn = cells(page);
        assertThat(drawn.get(0) / (double) drawn.get(1))
                .as("covered to covered again")
                .isBetween(5.5, 6.5);
        assertThat(drawn.get(2) / (double) drawn.get(1))
                .as("gaps to covered again")
                .isBetween(1.8, 2.2);
        Locator rows = page.find("table[aria-label='Worked area'] tbody tr");
        assertThat(rows).hasCount(1);
        assertThat(rows.locator(":is(th, td):not(:last-child)"))
                .hasText(new String[] {"barn", "weeding", "0.31 ha", "62 %", "0.06 ha", "0.02 ha", "30 min"});

        page.button("Close the table").click();
        Locator entry = page.find(".map-legend .legend-entry");
        entry.click();
        page.until(() -> cells(page).equals(List.of(0, 0, 0)));
        assertThat(entry).hasAttribute("aria-pressed", "false");
        assertThat(entry).isFocused();
    }

    @Test
    void showsTheAreaAsItGrowsAndOfTheChosenMission() {
        long now = System.currentTimeMillis();
        farm.has("data.coverage.layer", "w", value(layer("weeding", now, run(20, 1))))
                .has("data.coverage", "w", value(figures("weeding", "", now, 0.31)));
        FarmPage page = farm.open("", 1440, 900);
        page.until(() -> cells(page).get(0) > 100);
        int before = cells(page).get(0);
        farm.send("data.coverage.layer", "w", value(layer("weeding", now + 1, run(80, 1))));
        page.until(() -> cells(page).get(0) > 3 * before);
        page.until(
                () -> page.is(
                        "document.querySelector('furrow-map').devices.fieldLabels.drawn.some(({ line }) => line === '62 % worked')"));

        page.store("store.setScope({ domain: 'farm', mission: 'mowing' })");
        page.until(() -> cells(page).get(0) == 0);
    }

    /** What is worked live is not shown in it. */
    @Test
    void showsTheAreaOfAReplay() {
        long now = System.currentTimeMillis();
        String topic = "data.farm.replay.weeding.1";
        farm.hasReplay("weeding", "", "paused", START, START + 60_000, START + 50_000)
                .has("service.replays", "weeding.1", """
                        {"replay": "weeding.1", "mission": "weeding", "topic": "%s", "speed": 1, "analytics": ["coverage"]}""".formatted(topic))
                .answers("/api/history/data.coverage.layer", records(layer("weeding", now, run(20, 2))))
                .answers("/api/history/" + topic + ".coverage.layer", records(layer("weeding", START, run(20, 1))));
        FarmPage page = farm.open("", 1440, 900);
        page.until(() -> cells(page).get(1) > 100);

        page.open("#/map?replay=weeding.1");
        page.until(() -> cells(page).get(0) > 100);
        assertThat(cells(page).get(1)).isZero();
    }

    /** The pixels of the layer with covered, again covered and cells in gaps. */
    private static List<Integer> cells(FarmPage page) {
        return ((List<?>) page.run("""
                        () => {
                          const canvas = document.querySelectorAll('furrow-map canvas.map-canvas')[1];
                          const colors = [[0x0f, 0x8a, 0x7d], [0x5b, 0x3f, 0xb0], [0xb3, 0x6b, 0x00]];
                          const found = [0, 0, 0];
                          const { data } = canvas?.width ? canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height) : { data: [] };
                          for (let i = 0; i < data.length; i += 4) {
                            const code = data[i + 3] > 120 ? colors.findIndex((color) => color.every((part, at) => Math.abs(part - data[i + at]) < 4)) : -1;
                            code >= 0 && found[code]++;
                          }
                          return found;
                        }"""))
                .stream().map(each -> ((Number) each).intValue()).toList();
    }

    static String figures(String mission, String device, long time, double hectares) {
        return record("data.coverage", time, """
                {"id": "Analytics:Coverage:%1$s%2$s", "type": "Analytics:Coverage", "field": {"value": "barn"}, "fieldName": {"value": "barn"}, "Domain": {"value": "farm"}, "Mission": {"value": "%1$s"},
                 "device": {"value": "%2$s"}, "deviceType": {"value": "%3$s"}, "time": {"value": %4$d}, "startTime": {"value": %4$d}, "endTime": {"value": %4$d}, "hectares": {"value": %5$s},
                 "fieldHectares": {"value": 0.5}, "share": {"value": %6$s}, "overlapHectares": {"value": 0.06}, "gapHectares": {"value": 0.02}, "hectaresPerHour": {"value": 0.4}, "timeLeft": {"value": 1800000}}""".formatted(
                        mission, device, device.isEmpty() ? "" : "ROBOT", time, hectares, hectares / 0.5));
    }

    /** Ten by ten cells over the field. */
    static String layer(String mission, long time, byte[]... runs) {
        ByteArrayOutputStream all = new ByteArrayOutputStream();
        Arrays.stream(runs).forEach(all::writeBytes);
        return record("data.coverage.layer", time, """
                {"id": "Analytics:CoverageLayer:%1$s", "type": "Analytics:CoverageLayer", "field": {"value": "barn"}, "Domain": {"value": "farm"}, "Mission": {"value": "%1$s"}, "time": {"value": %2$d},
                 "box": {"value": [%3$s, %4$s, %5$s, %6$s]}, "columns": {"value": 10}, "rows": {"value": 10}, "runs": {"value": "%7$s"}}""".formatted(
                        mission,
                        time,
                        CORNER[0],
                        CORNER[1],
                        CORNER[0] + 0.001,
                        CORNER[1] + 0.001,
                        Base64.getEncoder().encodeToString(all.toByteArray())));
    }

    /** Cells of one code as on the topic: 4 × length + code, seven bits a byte. */
    static byte[] run(int length, int code) {
        int number = 4 * length + code;
        return number < 128 ? new byte[] {(byte) number} : new byte[] {(byte) (number | 128), (byte) (number >> 7)};
    }

    private static String record(String topic, long time, String value) {
        return "{\"topic\": \"%s\", \"kind\": \"event\", \"key\": \"k\", \"time\": %d, \"headers\": {}, \"value\": %s}"
                .formatted(topic, time, value);
    }

    private static String value(String record) {
        return record.substring(record.indexOf("\"value\": ") + "\"value\": ".length(), record.length() - 1);
    }

    static String records(String... records) {
        return Arrays.stream(records).collect(Collectors.joining(", ", "{\"since\": 0, \"records\": [", "]}"));
    }
}
