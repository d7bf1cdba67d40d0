package io.furrow.suite.page;

import java.nio.file.Files;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.deque.html.axecore.playwright.AxeBuilder;
import com.microsoft.playwright.Download;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The history of a device: its attributes over time, and the pictures of cameras. */
@Tag("full")
class HistoryIT extends StubbedPage {
    private static final long MINUTE = 60_000;
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";
    private static final String CAMERA = "urn:ngsi-ld:Camera:7";
    private static final String PATH = "/api/devices/" + ROBOT + "/history";
    /** A picture of one pixel. */
    private static final String PIXEL = "<svg xmlns='http://www.w3.org/2000/svg' width='4' height='3'/>";

    private final long now = System.currentTimeMillis();

    @BeforeEach
    void start() {
        farm.hasRobot(1).answers(PATH, history("number", 30));
    }

    /** The values are 0, 1, 2 and so on, the last one a minute ago. */
    private String history(String kind, int values) {
        long from = now - 60 * MINUTE;
        return """
                {"device": "r", "attribute": "speed", "from": %d, "to": %d, "since": %1$d, "kind": "%s", "unit": "MTS", "values": %d, "skipped": 0, "width": 0, "missions": [],
                 "points": %s}""".formatted(
                from,
                now,
                kind,
                values,
                IntStream.range(0, values)
                        .mapToObj(i -> "{\"time\": %d, \"value\": %d}".formatted(now - (values - i) * MINUTE, i))
                        .toList());
    }

    private List<String> requestsOf(FarmPage page) {
        List<String> requested = new CopyOnWriteArrayList<>();
        page.page().onRequest(request -> {
            if (request.url().contains("/history")) {
                requested.add(request.url());
            }
        });
        return requested;
    }

    private static String hash(FarmPage page) {
        return String.valueOf(page.run("location.hash"));
    }

    @Test
    void showsTwoAttributesOfADeviceAndTheSameAfterAReload() {
        FarmPage page = farm.open("", 1440, 900);
        List<String> requested = requestsOf(page);
        page.card(ROBOT).getByLabel("History of Robot 1").click();
        Locator panels = page.find(".history-panel");
        assertThat(panels).hasCount(1);
        assertThat(panels).containsText("Speed");
        assertThat(panels).containsText("29 m/s");
        assertThat(panels.locator("canvas")).isVisible();
        assertThat(panels.locator("[role=img]"))
                .hasAttribute("aria-label", Pattern.compile("lowest 0 m/s, highest 29"));
        page.until(() -> requested.stream()
                .anyMatch(
                        url -> url.contains("attribute=speed") && url.contains("type=ROBOT") && url.contains("from=")));

        page.page().getByLabel("Beside it").selectOption("Latitude");
        page.page().getByText("last 24 h").click();
        page.page().getByLabel("Threshold").first().fill("12.5");
        assertThat(panels).hasCount(2);
        page.until(() -> hash(page).contains("second=Latitude")
                && hash(page).contains("period=1440")
                && hash(page).contains("threshold=12.5"));
        page.page().reload();
        assertThat(panels).hasCount(2);
        assertThat(page.find(".segments [aria-pressed=true]")).hasText("last 24 h");
        assertThat(page.page().getByLabel("Threshold").first()).hasValue("12.5");
        assertThat(page.find("#history-device")).hasValue(ROBOT);
        assertThat(page.page()).hasTitle(Pattern.compile("History"));
    }

    @Test
    void readsAChosenPeriodAndTheRecordingOfAReplay() {
        farm.hasReplay("weeding", "", "paused", now - 50 * MINUTE, now - 40 * MINUTE, now - 45 * MINUTE)
                .answers("/api/missions/weeding/markers", "[]");
        FarmPage page = farm.open("#/history?select=" + ROBOT + "&between=1000~61000", 1440, 900);
        List<String> requested = requestsOf(page);
        page.page().reload();
        page.until(() -> requested.stream().anyMatch(url -> url.contains("from=1000&to=61000")));
        page.button("From … to").click();
        assertThat(page.find("#history-from")).hasValue("1970-01-01 01:00:01");
        page.find("#history-to").fill("1970-01-01 01:00:31");
        page.button("Show").click();
        page.until(() -> requested.stream().anyMatch(url -> url.contains("from=1000&to=31000")));

        page.run("location.hash = '#/history?select=" + ROBOT + "&replay=weeding.1&attribute=speed'");
        assertThat(page.find(".mode")).containsText("Replay of weeding");
        assertThat(page.find("furrow-history")).containsText("in mission weeding");
        page.until(() -> requested.stream().anyMatch(url -> url.contains("mission=weeding")));
    }

    @Test
    void beginsWhereSomethingIsStored() {
        farm.answers(PATH, history("number", 3).replaceAll("\"since\": \\d+", "\"since\": " + (now - 4 * MINUTE)));
        FarmPage page = farm.open("#/history?select=" + ROBOT, 1440, 900);
        Locator chart = page.find(".history-panel [role=img]");
        assertThat(chart).isVisible();
        page.until(() ->
                page.is("document.querySelector('furrow-history').panels[0].chart.range[0] === " + (now - 4 * MINUTE)));

        page.run("location.hash = '#/history?select=" + ROBOT + "&between=" + (now - 60 * MINUTE) + "~" + now + "'");
        page.until(() -> page.is(
                "document.querySelector('furrow-history').panels[0].chart.range[0] === " + (now - 60 * MINUTE)));
    }

    @Test
    void distinguishesLoadingEmptyAndFailed() {
        farm.answers(PATH, "");
        FarmPage page = farm.open("#/history?select=" + ROBOT, 1440, 900);
        assertThat(page.find(".history-panel [aria-busy=true]")).isVisible();

        farm.answers(PATH, "503 MongoDB is away");
        page.expectingError("503");
        page.page().reload();
        assertThat(page.find(".history-panel [role=alert]")).containsText("MongoDB is away");
        farm.answers(PATH, history("none", 0));
        page.button("Try again").click();
        assertThat(page.find(".history-panel")).containsText("No value in this period");
        farm.answers(PATH, history("other", 0));
        page.page().reload();
        assertThat(page.find(".history-panel")).containsText("No number and no text");
    }

    @Test
    void listsTheChangesOfAText() throws Exception {
        String changes =
                "\"changes\": [{\"time\": %d, \"value\": \"{%%27data%%27: %%27stopped%%27}\"}, {\"time\": %d, \"value\": \"idle\"}],"
                        .formatted(now - 2 * MINUTE, now - MINUTE);
        farm.isReadIn("es").answers(PATH, history("text", 0).replace("\"missions\"", changes + " \"missions\""));
        FarmPage page = farm.open("#/history?attribute=state&select=" + ROBOT, 1440, 900);
        Locator panel = page.find(".history-panel");
        assertThat(panel.locator("tbody tr")).hasCount(2);
        assertThat(panel.locator("tbody tr").first()).containsText("inactivo");
        assertThat(panel.locator("tbody tr").last()).containsText("parado");
        assertThat(panel.getByText("PNG")).isHidden();
        assertThat(page.find("#history-attribute-0 option"))
                .hasText(new String[] {"Velocidad", "Latitud", "Longitud", "Estado"});
        Download csv = page.page().waitForDownload(() -> page.button("CSV").click());
        assertThat(Files.readAllLines(csv.path()).get(2)).endsWith("Z,Robot 1,state,idle,");
    }

    @Test
    void savesThePointsAndThePicture() throws Exception {
        FarmPage page = farm.open("#/history?select=" + ROBOT, 1440, 900);
        assertThat(page.find(".history-panel canvas")).isVisible();
        Download csv = page.page().waitForDownload(() -> page.button("CSV").click());
        assertThat(csv.suggestedFilename()).startsWith("Robot-1-speed-").endsWith(".csv");
        List<String> lines = Files.readAllLines(csv.path());
        assertThat(lines).hasSize(31).startsWith("\ufefftime,device,attribute,value,unit");
        assertThat(lines.get(30)).endsWith("Z,Robot 1,speed,29,m/s");
        Download png = page.page().waitForDownload(() -> page.button("PNG").click());
        assertThat(Files.readAllBytes(png.path()))
                .startsWith(0x89, 'P', 'N', 'G')
                .hasSizeGreaterThan(2_000);

        page.button("Table").click();
        assertThat(page.find(".history-panel tbody tr")).hasCount(30);
        assertThat(page.find(".history-panel tbody tr").first()).containsText("29 m/s");
    }

    private FarmPage withPictures(String hash) {
        farm.has("data.raw", CAMERA, """
                        {"id": "%s", "type": "Camera", "Domain": {"value": "farm"}, "Mission": {"value": "weeding"}}""".formatted(CAMERA))
                .answers(
                        "/api/history/data.images",
                        "{\"since\": 0, \"records\": ["
                                + IntStream.range(0, 3)
                                        .mapToObj(i ->
                                                "{\"topic\": \"data.images\", \"kind\": \"event\", \"key\": \"%1$s\", \"time\": %2$d, \"headers\": {}, \"value\": {\"entity\": \"%1$s\", \"type\": \"Camera\", \"sha256\": \"p%3$d\"}}"
                                                        .formatted(CAMERA, now - (3 - i) * MINUTE, i))
                                        .collect(Collectors.joining(","))
                                + "]}");
        FarmPage page = farm.open("", 1440, 900);
        page.page()
                .route(
                        "**/api/images/*",
                        route -> route.fulfill(new Route.FulfillOptions()
                                .setContentType("image/svg+xml")
                                .setBody(PIXEL)));
        page.run("location.hash = '" + hash + "'");
        return page;
    }

    @Test
    void showsThePicturesOfACameraOneAfterTheOther() {
        FarmPage page = withPictures("#/history?select=" + CAMERA);
        Locator caption = page.find(".history-picture figcaption");
        assertThat(caption).containsText("3 of 3");
        assertThat(page.find(".history-picture img")).isVisible();
        assertThat(page.button("Next picture")).isDisabled();
        page.button("Previous picture").click();
        assertThat(caption).containsText("2 of 3");
        page.button("Previous picture").press("ArrowLeft");
        assertThat(caption).containsText("1 of 3");
        assertThat(page.page()
                        .getByLabel("Picture", new com.microsoft.playwright.Page.GetByLabelOptions().setExact(true)))
                .isFocused();
        page.page().keyboard().press("ArrowRight");
        assertThat(caption).containsText("2 of 3");

        page.until(() -> hash(page).contains("picture=" + (now - 2 * MINUTE)));
        page.page().reload();
        assertThat(caption).containsText("Camera 7");
        assertThat(caption).containsText("2 of 3");
    }

    @Test
    void leadsFromAnEncounterToThePicturesAroundIt() {
        farm.hasRobot(2)
                .answers("/api/history/data.collision", """
                        {"since": 0, "records": [{"topic": "data.collision", "kind": "event", "key": "e", "time": %1$d, "headers": {}, "value": {"type": "Analytics:Collision",
                          "encounter": {"value": "e"}, "phase": {"value": "ended"}, "time": {"value": %1$d}, "startTime": {"value": %2$d}, "minDistance": {"value": 3},
                          "Device1_ID": {"value": "%3$s"}, "Device2_ID": {"value": "urn:ngsi-ld:Robot:2"}}}]}""".formatted(now - MINUTE, now - 2 * MINUTE, ROBOT))
                .has("service.alarms", "c", """
                        {"alarm": "c", "kind": "collision", "severity": "critical", "text": "…", "values": {"meters": 2.14}, "subject": "c", "raised": %d, "count": 1, "state": "open",
                         "devices": [{"id": "%s", "type": "ROBOT"}]}""".formatted(now - 2 * MINUTE, ROBOT));
        FarmPage page = withPictures("#/analyses");
        List<String> requested = requestsOf(page);
        page.page().getByLabel("Pictures around").click();
        assertThat(page.find(".history-picture figcaption")).containsText("3 of 3");
        String around = "data.images?from=%d&to=%d".formatted(now - 2 * MINUTE - 30_000, now - MINUTE + 30_000);
        page.until(() -> requested.stream().anyMatch(url -> url.contains(around)));

        page.go("Map");
        page.find("furrow-alarms .alarm.critical a").click();
        String ofAlarm = "data.images?from=%d&to=%d".formatted(now - 2 * MINUTE - 30_000, now - 2 * MINUTE + 30_000);
        page.until(() -> requested.stream().anyMatch(url -> url.contains(ofAlarm)));
    }

    @Test
    void fitsAndIsAccessibleAtEachSize() {
        for (int[] size : new int[][] {{1440, 900}, {1024, 768}, {768, 1024}, {390, 844}, {740, 360}}) {
            FarmPage page = farm.open("#/history?select=" + ROBOT + "&second=Latitude&pictures=all", size[0], size[1]);
            assertThat(page.find(".history-panel canvas")).hasCount(2);
            assertThat(page.find(".history-pictures .empty")).isVisible();
            assertThat(
                            page.number(
                                    "document.querySelector('.view-place').scrollWidth - document.querySelector('.view-place').clientWidth"))
                    .as("width %d", size[0])
                    .isZero();
            assertThat(page.button("PNG").first().boundingBox().y)
                    .as("width %d", size[0])
                    .isEqualTo(page.button("Table").first().boundingBox().y);
            assertThat(new AxeBuilder(page.page()).analyze().getViolations())
                    .as("width %d", size[0])
                    .extracting(rule -> rule.getId())
                    .isEmpty();
        }
    }
}
