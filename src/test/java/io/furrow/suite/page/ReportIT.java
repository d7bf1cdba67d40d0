package io.furrow.suite.page;

import java.io.IOException;
import java.nio.file.Files;
import java.time.Instant;
import java.util.List;

import com.deque.html.axecore.playwright.AxeBuilder;
import com.microsoft.playwright.Download;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.options.ColorScheme;
import com.microsoft.playwright.options.Media;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The report of a mission on one page, on paper, and the tables of views as CSV. */
@Tag("full")
class ReportIT extends StubbedPage {
    private static final long START = Instant.parse("2026-01-01T03:04:30Z").toEpochMilli();
    private static final long END = START + 2 * 3_600_000 + 5 * 60_000;
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";
    /** What a spreadsheet would run. */
    private static final String FORMULA = "=HYPERLINK(1)";

    @BeforeEach
    void start() {
        String mission = """
                {"mission": "weeding", "domain": "farm", "template": "two@1", "running": false, "start": %d, "created": %d, "sequence": 2, "deviceCount": 1,
                 "status": {"mission": "weeding", "domain": "farm", "state": "stopped", "since": %d, "sequence": 2, "devices": 1, "confirmed": 1, "missing": []}}""".formatted(START, START, END);
        farm.hasField("barn", "farm", -3.482, 40.312)
                .hasField("far", "other", -3.5, 40.4)
                .answers("/api/missions", "[" + mission + "]")
                .answers("/api/missions/weeding", mission)
                .answers(
                        "/api/recordings",
                        "[{\"mission\": \"weeding\", \"first\": %d, \"last\": %d}]".formatted(START, END))
                .answers(
                        "/api/devices",
                        "[{\"id\": \"%s\", \"type\": \"ROBOT\", \"domain\": \"farm\", \"mission\": \"weeding\", \"from\": 0, \"sequence\": 1, \"status\": {\"state\": \"stopped\"}}]"
                                .formatted(ROBOT))
                .answers(
                        "/api/history/data.coverage",
                        CoverageIT.records(
                                CoverageIT.figures("weeding", "", END, 0.31),
                                CoverageIT.figures("weeding", ROBOT, END, 0.25),
                                CoverageIT.figures("mowing", "", END, 0.4)))
                .answers(
                        "/api/history/data.coverage.layer",
                        CoverageIT.records(CoverageIT.layer(
                                "weeding", END, CoverageIT.run(50, 1), CoverageIT.run(10, 2), CoverageIT.run(40, 0))))
                .answers(
                        "/api/history/data.collision",
                        CoverageIT.records(
                                encounter("e1", "weeding", 90_000, 3.25), encounter("e2", "mowing", 60_000, 1)))
                .answers(
                        "/api/history/data.temperature",
                        CoverageIT.records(average("barn", 0, 18), average("barn", 60_000, 21), average("far", 0, 40)))
                .answers("/api/missions/weeding/markers", """
                        [{"id": "m1", "mission": "weeding", "time": %d, "note": "%s", "author": "olga"}]""".formatted(START + 5_000, FORMULA))
                .has("service.alarms", "c", alarm("c", "urn:ngsi-ld:Mission:weeding", START + 1_000))
                .has("service.alarms", "d", alarm("d", "urn:ngsi-ld:Mission:mowing", START + 1_000))
                .has("service.alarms", "e", alarm("e", "urn:ngsi-ld:Mission:weeding", END + 1_000));
    }

    @Test
    void showsTheFiguresOfAnEndedMission() {
        FarmPage page = farm.open("#/missions?mission=weeding", 1440, 900);
        page.find(".mission-detail a[data-act=report]").click();

        assertThat(page.find("furrow-report h1")).hasText("Report of weeding");
        Locator facts = page.find(".report-facts dd");
        assertThat(facts.nth(0)).containsText("1 Jan 2026, 04:04:30 – 06:09:30");
        assertThat(facts.nth(1)).hasText("2 h 5 min");
        assertThat(facts.nth(2)).hasText("0.31 ha62 % of 0.50 ha");
        assertThat(facts.nth(3)).hasText("1closest 3.3 m");
        assertThat(facts).hasCount(7);
        assertThat(rows(page, "coverages"))
                .hasText(new String[] {"barn0.31 ha0.50 ha62 %0.06 ha0.02 ha1 Jan 2026, 06:09:301 Jan 2026, 06:09:30"});
        assertThat(rows(page, "encounters")).hasText(new String[] {"1 Jan 2026, 04:06:00a – b3.3 m10 sended"});
        assertThat(rows(page, "averages")).hasText(new String[] {"barn19.5 °C18.0 °C21.0 °C2none"});
        assertThat(rows(page, "alarms")).hasCount(1);
        assertThat(rows(page, "markers")).hasText(new String[] {"1 Jan 2026, 04:04:35" + FORMULA + "olga"});
        assertThat(rows(page, "devices")).hasText(new String[] {"Robot 1ROBOTStopped0.25 ha0.06 ha–"});
        assertThat(page.find(".report-map")).hasCount(1);
        assertThat(page.find(".report-map svg"))
                .hasAttribute("aria-label", "Map of the fields with what was worked. barn: 0.31 ha, 62 %");
        assertThat(page.find(".report-cells[data-cells=worked]")).hasCount(1);
        assertThat(page.find(".report-cells[data-cells=gap]")).hasCount(0);

        page.page().reload();
        assertThat(page.find("furrow-report h1")).hasText("Report of weeding");
        assertThat(page.page()).hasTitle("Report of weeding · Furrow");
        assertThat(rows(page, "coverages")).hasCount(1);
    }

    @Test
    void printsInLightColorsWithoutTheFrame() {
        FarmPage page = farm.open("#/report?mission=weeding", 1440, 900);
        page.page().emulateMedia(new Page.EmulateMediaOptions().setColorScheme(ColorScheme.DARK));
        assertThat(rows(page, "coverages")).hasCount(1);
        assertThat(page.find("body")).hasCSS("color", "rgb(232, 240, 234)");
        page.run("() => { window.print = () => { window.printed = true; }; }");
        page.button("Print or save as PDF").click();
        assertThat(page.is("window.printed")).isTrue();

        page.page().emulateMedia(new Page.EmulateMediaOptions().setMedia(Media.PRINT));
        assertThat(page.find("body")).hasCSS("color", "rgb(23, 33, 27)");
        for (String hidden : List.of(".topbar", ".rail", ".report-acts", ".report .csv >> nth=0")) {
            assertThat(page.find(hidden)).isHidden();
        }
        assertThat(rows(page, "devices")).isVisible();
        assertThat(page.number("document.scrollingElement.scrollHeight"))
                .isGreaterThan(page.number("document.querySelector('.report').getBoundingClientRect().height") - 1);
        assertThat(page.page().pdf()).startsWith("%PDF".getBytes());
    }

    @Test
    void savesItsTables() throws IOException {
        FarmPage page = farm.open("#/report?mission=weeding", 1440, 900);

        assertThat(csv(page, "Worked area", "weeding-coverages.csv"))
                .isEqualTo("Field,Worked (ha),Field area (ha),Share (%),Worked again (ha),Gaps (ha),From,To\r\n"
                        + "barn,0.31,0.5,62,0.06,0.02,2026-01-01T05:09:30.000Z,2026-01-01T05:09:30.000Z\r\n");
        assertThat(csv(page, "Notes", "weeding-markers.csv"))
                .isEqualTo("When,Note,Who\r\n2026-01-01T03:04:35.000Z,'" + FORMULA + ",olga\r\n");
    }

    @Test
    void savesTheTablesOfViews() throws IOException {
        long now = System.currentTimeMillis();
        farm.answers("/api/audit", """
                        [{"time": %d, "user": "olga", "target": "service.missionmanager", "command": "start", "about": {"mission": "weeding"}, "result": "started"}]""".formatted(START))
                .answers(
                        "/api/history/data.collision",
                        CoverageIT.records(encounter("e1", "weeding", now - START, 3.25)))
                .answers("/api/history/data.temperature", CoverageIT.records(average("barn", now - START - 60_000, 18)))
                .answers("/api/history/data.presence", CoverageIT.records("""
                        {"topic": "data.presence", "kind": "event", "key": "k", "time": %1$d, "headers": {}, "value": {"type": "Analytics:Presence", "stay": {"value": "s"}, "device": {"value": "+1"},
                         "field": {"value": "barn"}, "startTime": {"value": %1$d}, "time": {"value": %1$d}, "phase": {"value": "left"}}}""".formatted(now - 10_000)));
        FarmPage page = farm.open("#/missions", 1440, 900);
        assertThat(page.find(".mission-row")).hasCount(1);
        assertThat(csv(page, "Missions", "missions.csv"))
                .startsWith("Mission,Domain,Template,State,Since,Started,Devices,In the desired state\r\n")
                .contains("\r\nweeding,farm,two@1,stopped,2026-01-01T05:09:30.000Z,2026-01-01T03:04:30.000Z,1,1\r\n");

        page.open("#/missions?tab=audit");
        assertThat(csv(page, "Who commanded what", "audit.csv"))
                .isEqualTo(
                        "When,Who,Command,About,Result\r\n2026-01-01T03:04:30.000Z,olga,mission start,mission weeding,started\r\n");

        page.open("#/replays");
        assertThat(page.find(".recordings tbody tr")).hasCount(1);
        assertThat(csv(page, "Recorded missions", "recordings.csv"))
                .contains("\r\nweeding,farm,2026-01-01T03:04:30.000Z,2026-01-01T05:09:30.000Z,7500,");

        page.open("#/analyses");
        assertThat(csv(page, "Encounters", "encounters.csv")).contains(",a – b,3.25,10,ended\r\n");
        assertThat(csv(page, "Averages per field", "averages.csv")).contains(",barn,18,17.5,4,,robust\r\n");
        assertThat(csv(page, "Presence in fields", "presence.csv")).contains("\r\nbarn,'+1,");
    }

    /** With an hour between them; one of its robots has a clock that is behind. */
    @Test
    void tellsTheRunsOfAMissionAndWhoseReportsWereLate() throws IOException {
        farm.answers("/api/recordings/weeding/timeline", """
                        {"from": %d, "width": 1800000, "first": %d, "last": %d, "complete": true, "counts": [5, 5, 0, 0, 4]}""".formatted(START, START, END))
                .answers("/api/history/data.clocks", CoverageIT.records("""
                        {"topic": "data.clocks", "kind": "event", "key": "k", "time": %d, "headers": {}, "value": {"id": "Analytics:ClockBehind:%2$s", "type": "Analytics:ClockBehind", "device": {"value": "%2$s"},
                         "late": {"value": 45000}, "Mission": {"value": "weeding"}}}""".formatted(START + 60_000, ROBOT)));
        FarmPage page = farm.open("#/report?mission=weeding", 1440, 900);

        assertThat(rows(page, "runs")).hasText(new String[] {
            "1 Jan 2026, 04:04:301 Jan 2026, 05:04:3060 min", "1 Jan 2026, 06:04:301 Jan 2026, 06:09:305 min"
        });
        Locator facts = page.find(".report-facts dd");
        assertThat(facts.nth(0)).containsText("2 runs");
        assertThat(facts.nth(1)).hasText("1 h 5 min");
        assertThat(rows(page, "devices")).hasText(new String[] {"Robot 1ROBOTStopped0.25 ha0.06 ha45 s"});
        assertThat(csv(page, "Runs", "weeding-runs.csv"))
                .isEqualTo("From,To,Length (s)\r\n"
                        + "2026-01-01T03:04:30.000Z,2026-01-01T04:04:30.000Z,3600\r\n"
                        + "2026-01-01T05:04:30.000Z,2026-01-01T05:09:30.000Z,300\r\n");
    }

    @Test
    void leavesOutTimesOfAClockThatIsYearsOff() {
        farm.answers("/api/recordings", "[{\"mission\": \"weeding\", \"first\": 1000, \"last\": %d}]".formatted(END));
        FarmPage page = farm.open("#/report?mission=weeding", 1440, 900);

        assertThat(page.find(".report-facts dd").nth(0)).containsText("1 Jan 2026, 04:04:30 – 06:09:30");
        assertThat(page.find(".report-facts dd").nth(0)).containsText("the clock of a device was wrong");
        assertThat(page.find(".report-facts dd").nth(1)).hasText("2 h 5 min");
    }

    /** No row of figures has one alone. */
    @ParameterizedTest
    @CsvSource({"1440, 8", "1100, 4", "740, 4", "390, 2"})
    void fillsTheRowsOfFigures(int width, int columns) {
        FarmPage page = farm.open("#/report?mission=weeding", width, 900);
        assertThat(page.find(".report-facts > div")).hasCount(7);

        assertThat(
                        page.run(
                                "getComputedStyle(document.querySelector('.report-facts')).gridTemplateColumns.split(' ').length"))
                .isEqualTo(columns);
        assertThat(
                        page.number(
                                "[...document.querySelectorAll('.report-facts > div')].filter((each, index, all) => !all.some((other) => other !== each && other.offsetTop === each.offsetTop)).length"))
                .isLessThanOrEqualTo(columns == 2 ? 1 : 0); // the first has a row of two columns
    }

    /** Three states that must not be taken for one another. */
    @Test
    void tellsWhatIsReadWhatFailedAndWhatIsEmpty() {
        farm.answers("/api/history/data.collision", "503 Kafka is away").answers("/api/missions/weeding", "");
        FarmPage page = farm.open("#/report?mission=weeding", 1440, 900).expectingError("status of (503|404)");
        assertThat(page.find("furrow-report [aria-busy=true]")).isVisible();

        farm.answers("/api/missions/weeding", "503 the control plane is away");
        page.page().reload();
        assertThat(page.find("furrow-report .error-note")).containsText("the control plane is away");

        farm.answers("/api/missions/weeding", "404 no such mission");
        page.button("Try again").click();
        assertThat(page.find(".report-encounters .error-note")).containsText("Kafka is away");
        assertThat(rows(page, "averages")).hasCount(1);

        farm.answers("/api/missions/next", "{\"mission\": \"next\", \"domain\": \"farm\", \"running\": false}");
        page.open("#/report?mission=next");
        assertThat(page.find("furrow-report .empty")).containsText("Nothing to report yet");
    }

    @ParameterizedTest
    @CsvSource({"1440, 900, DARK", "390, 844, LIGHT", "740, 360, DARK"})
    void fitsTheWindowAndIsAccessible(int width, int height, ColorScheme scheme) {
        FarmPage page = farm.open("#/report?mission=weeding", width, height);
        page.page().emulateMedia(new Page.EmulateMediaOptions().setColorScheme(scheme));
        assertThat(rows(page, "coverages")).hasCount(1);

        assertThat(page.number("document.querySelector('.view-place').scrollWidth"))
                .isLessThanOrEqualTo(page.number("document.querySelector('.view-place').clientWidth"));
        assertThat(new AxeBuilder(page.page()).analyze().getViolations())
                .extracting(rule -> rule.getId())
                .isEmpty();
    }

    private static Locator rows(FarmPage page, String section) {
        return page.find(".report-" + section + " tbody tr");
    }

    /** The text of a saved table, without the byte order mark. */
    static String csv(FarmPage page, String table, String file) throws IOException {
        Download saved = page.page()
                .waitForDownload(() -> page.button("Save as CSV: " + table).click());
        assertThat(saved.suggestedFilename()).isEqualTo(file);
        String text = Files.readString(saved.path());
        assertThat(text).startsWith("\ufeff");
        return text.substring(1);
    }

    private static String encounter(String id, String mission, long after, double closest) {
        return """
                {"topic": "data.collision", "kind": "event", "key": "%1$s", "time": %2$d, "headers": {}, "value": {"type": "Analytics:Collision", "encounter": {"value": "%1$s"}, "phase": {"value": "ended"},
                 "startTime": {"value": %2$d}, "time": {"value": %3$d}, "minDistance": {"value": %4$s}, "Device1_ID": {"value": "a"}, "Device2_ID": {"value": "b"}, "Device1_Mission": {"value": "%5$s"}}}""".formatted(id, START + after, START + after + 10_000, closest, mission);
    }

    private static String average(String field, long after, double value) {
        return """
                {"topic": "data.temperature", "kind": "event", "key": "k", "time": %2$d, "headers": {}, "value": {"type": "Analytics:FieldTemperature", "field": {"value": "%1$s"}, "averageTemperature": {"value": %3$s},
                 "plainMean": {"value": 17.5}, "devices": {"value": 4}, "suspects": {"value": []}, "quality": {"value": "robust"}, "windowStart": {"value": %4$d}, "windowEnd": {"value": %2$d}}}""".formatted(field, START + after + 60_000, value, START + after);
    }

    private static String alarm(String id, String group, long raised) {
        return """
                {"alarm": "%s", "kind": "silent-device", "severity": "minor", "text": "It is silent", "subject": "%s", "group": "%s", "raised": %d, "changed": %d, "count": 1, "state": "closed"}""".formatted(id, group, group, raised, raised + 60_000);
    }
}
