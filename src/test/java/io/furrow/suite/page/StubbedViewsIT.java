package io.furrow.suite.page;

import java.net.URI;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.options.FilePayload;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** What views show of records and responses that a running farm seldom has. */
@Tag("full")
class StubbedViewsIT extends StubbedPage {
    private static final long MINUTE = 60_000;
    private static final long START = Instant.parse("2026-01-01T03:04:30Z").toEpochMilli();

    /** A status from before the pause may arrive after it. */
    @Test
    void stepsAReplayThatIsPausedAlready() {
        farm.hasReplay("weeding", "", "running", START, START + MINUTE, START + 1_000)
                .answers(
                        "/api/replays/weeding.1/pause",
                        "409 replay 'weeding.1' is paused, which 'pause' cannot change");
        FarmPage page = farm.open("#/map?replay=weeding.1", 1440, 900).expectingError("status of 409");
        page.untilStore("store.mode.state === 'running'");
        page.button("Step forward").click();

        page.until(() -> farm.sent().contains("POST /api/replays/weeding.1/step {\"count\":1}"));
    }

    @Test
    void keepsTheReplayWhenThePageIsLoadedAgain() {
        farm.hasReplay("weeding", "", "paused", START, START + MINUTE, START + 1_000);
        FarmPage page = farm.open("", 1440, 900);
        page.untilStore("Boolean(store.replays.get('weeding.1')?.topic && store.replays.get('weeding.1').status)");
        page.store("store.enterReplay(store.replays.get('weeding.1'))");
        assertThat(page.page()).hasURL(Pattern.compile("#/map\\?replay=weeding\\.1$"));

        page.page().reload();
        assertThat(page.find(".mode")).containsText("Replay of weeding");
        page.button("Back to live").click();
        assertThat(page.page()).hasURL(Pattern.compile("#/map$"));
    }

    /** Else its beginning is shown first. */
    @Test
    void seeksTheMomentOfAReplayBeforeItIsPlayed() {
        farm.answers("/api/replays", "{\"replay\": \"weeding.9\"}");
        FarmPage page = farm.open("", 1440, 900);
        page.until(() -> page.is("Boolean(document.querySelector('furrow-timeline').startAt)"));
        page.run("() => { document.querySelector('furrow-timeline').startAt(['weeding'], 1234); }");

        page.until(() -> farm.sent().contains("POST /api/replays/weeding.9/seek {\"to\":1234}"));
        assertThat(page.find(".mode")).hasText("Live");
    }

    /** The topics of results are created with their first record. */
    @Test
    void requestsNoTopicThatDoesNotExist() {
        farm.hasReplay("weeding", "", "paused", START, START + MINUTE, START + 1_000);
        FarmPage page = farm.open("", 1440, 900);
        List<String> requested = new ArrayList<>();
        page.page().onRequest(request -> requested.add(URI.create(request.url()).getPath()));
        page.untilStore("Boolean(store.replays.get('weeding.1')?.topic && store.replays.get('weeding.1').status)");
        page.store("store.enterReplay(store.replays.get('weeding.1'))");
        page.go("Analyses");
        assertThat(page.find("furrow-analyses .encounters .empty")).isVisible();
        String topic = "/api/register/data.farm.replay.weeding.1";
        page.until(() -> requested.containsAll(List.of(topic, "/api/topics")));

        assertThat(requested).noneMatch(each -> each.matches(".*/data\\.farm\\.replay\\.weeding\\.1\\.\\w+"));
    }

    /** What is shown first does not wait for the work of other streams, and no stream waits for one that does not answer. */
    @Test
    void opensThreeStreamsAtATime() {
        List.of("service.alarms", "service.fields", "service.replays")
                .forEach(topic -> farm.answers("/api/register/" + topic, ""));
        FarmPage page = farm.open("", 1440, 900);
        Map<String, Long> registered = new ConcurrentHashMap<>();
        page.page().onRequest(request -> {
            String path = URI.create(request.url()).getPath();
            if (path.startsWith("/api/register/")) {
                registered.put(path.substring("/api/register/".length()), System.nanoTime());
            }
        });
        page.page().reload();
        page.until(() -> registered.containsKey("service.replays.status"));

        assertThat(registered.get("service.replays.status") - registered.get("service.replays"))
                .isGreaterThan(TimeUnit.MILLISECONDS.toNanos(500));
    }

    /** Else the lists of a large farm delay them. */
    @Test
    void requestsListsAfterTheStatesOfDevices() {
        FarmPage page = farm.open("", 1440, 900);
        List<String> events = new CopyOnWriteArrayList<>();
        page.page().onRequest(request -> events.add(URI.create(request.url()).getPath()));
        page.page()
                .onRequestFinished(request ->
                        events.add("answered " + URI.create(request.url()).getPath()));
        page.page().reload();
        page.until(() -> events.contains("answered /api/devices"));

        assertThat(events).containsSubsequence("answered /api/register/data.raw", "/api/devices");
    }

    /** The pill with the distance has some 2,000 pixels in the color of the scheme. */
    @Test
    void drawsTheDistanceOfAnEncounter() {
        farm.hasRobot(1).hasRobot(2).has("data.collision", "e", """
                {"type": "Analytics:Collision", "encounter": {"value": "e"}, "phase": {"value": "ongoing"}, "distance": {"value": 4}, "minDistance": {"value": 3},
                 "Device1_ID": {"value": "urn:ngsi-ld:Robot:1"}, "Device2_ID": {"value": "urn:ngsi-ld:Robot:2"}}""");
        FarmPage page = farm.open("", 1440, 900);

        page.until(() -> page.mapPixels(0xb3261e) > 1_000);
    }

    /** Else a search would push the farm out of the map. */
    @Test
    void selectsAFoundDeviceThatIsInViewWithoutMovingTheMap() {
        farm.hasRobot(1).hasRobot(2);
        FarmPage page = farm.open("", 1440, 900);
        assertThat(page.card("urn:ngsi-ld:Robot:2")).isVisible();
        page.until(() -> page.is("document.querySelector('furrow-map').devices?.spots.length === 2"));
        page.find("input[type=search]").first().fill("robot 2");
        page.find("input[type=search]").first().press("Enter");

        assertThat(page.card("urn:ngsi-ld:Robot:2")).hasClass(Pattern.compile("selected"));
        assertThat(page.page()).hasURL(Pattern.compile("select="));
        assertThat(page.is("document.querySelector('furrow-map').moved ?? false"))
                .isFalse();
    }

    @Test
    void deletesAMarker() {
        farm.hasReplay("weeding", "", "paused", START, START + MINUTE, START + 1_000)
                .answers("/api/missions/weeding/markers", """
                        [{"id": "m1", "mission": "weeding", "time": %d, "note": "a stone", "author": "demo"}]""".formatted(START + 2_000));
        FarmPage page = farm.open("#/map?replay=weeding.1", 1440, 900);
        assertThat(page.find(".tl-flag")).hasCount(1);
        page.button("Add a marker").click();
        page.button("Delete marker a stone").click();
        assertThat(farm.sent()).isEmpty();
        page.find("dialog[open] .button.danger").click();

        page.until(() -> farm.sent().contains("DELETE /api/missions/weeding/markers/m1 null"));
        assertThat(page.find("dialog[open] li")).hasCount(0);
    }

    /** Two missions were recorded at the moment that is chosen, a third was not. */
    @Test
    void offersTheMissionsThatWereRecordedAtAMoment() {
        long now = System.currentTimeMillis();
        String recording = "{\"mission\": \"%s\", \"first\": %d, \"last\": %d}";
        farm.answers(
                "/api/recordings",
                "[" + recording.formatted("weeding", now - 9 * MINUTE, now) + ","
                        + recording.formatted("scouting", now - 9 * MINUTE, now) + ","
                        + recording.formatted("mowing", now - 20 * MINUTE, now - 15 * MINUTE) + "]");
        FarmPage page = farm.open("", 1440, 900);
        page.untilStore("store.recordings.size === 3");
        assertThat(page.find(".tl-track")).isVisible();
        page.run("document.querySelector('furrow-timeline').choose(Date.now() - 60000)");
        page.find(".tl-start").click();

        assertThat(page.find("furrow-replays .plan h2"))
                .hasText(Pattern.compile("Replay of (weeding \\+ scouting|scouting \\+ weeding)"));
        assertThat(page.find(".live-word")).hasCount(0); // their missions do not run
    }

    @Test
    void namesTheSeverityOfAnAlarmAndTheDeviceOfACommand() {
        farm.hasRobot(1).has("service.alarms", "a", """
                {"alarm": "a", "kind": "silent-device", "severity": "minor", "text": "the pump is silent", "subject": "pump", "raised": 1, "count": 1, "state": "open"}""");
        FarmPage page = farm.open("", 1440, 900);

        assertThat(page.find("furrow-alarms li.alarm")).containsText("Minor · Silent device");
        assertThat(page.button("Acknowledge: the pump is silent")).isVisible();
        assertThat(page.button("Stop: Robot 1")).isVisible();
        page.button("The map as a table").click();
        assertThat(page.find(".map-table")).isVisible();
        page.page().keyboard().press("Escape");
        assertThat(page.find(".map-table")).isHidden();
    }

    @Test
    void marksTheDomainOfAFieldThatDoesNotExist() {
        String geometry = "\"geometry\": {\"type\": \"Polygon\", \"coordinates\": []}";
        farm.answers("/api/domains", "[{\"domain\": \"farm\"}]")
                .has(
                        "service.fields",
                        "a@2020-01-01T00:00:00Z",
                        "{\"properties\": {\"Domain\": \"farm\"}, " + geometry + "}")
                .has(
                        "service.fields",
                        "b@2020-01-01T00:00:00Z",
                        "{\"properties\": {\"Domain\": \"barn\"}, " + geometry + "}");
        FarmPage page = farm.open("#/missions?tab=domains", 1440, 900);

        assertThat(page.find(".field-table td.warn")).hasText(new String[] {"barn does not exist"});
    }

    @Test
    void leavesAButtonInPlaceWhileItIsPressed() {
        farm.hasField("a", "farm", 1, 2);
        FarmPage page = farm.open("#/missions?tab=domains", 1440, 900);
        page.find(".field-table").getByLabel("Rename a").hover();
        page.page().mouse().down();
        farm.send(
                "service.fields",
                "b@2020-01-01T00:00:00Z",
                "{\"properties\": {}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": []}}");
        page.untilStore("store.fields.size === 2");
        page.page().mouse().up();

        assertThat(page.find("dialog[open]")).isVisible();
        assertThat(page.find(".field-table tbody tr")).hasCount(2);
    }

    @Test
    void importsNoFileWithoutAreas() {
        FarmPage page = farm.open("#/missions?tab=domains", 1440, 900);
        page.button("Import fields").click();
        Locator dialog = page.find("dialog[open]");
        dialog.getByLabel("File")
                .setInputFiles(
                        new FilePayload("empty.geojson", "application/geo+json", "{\"features\": []}".getBytes(UTF_8)));

        assertThat(dialog).containsText("Areas in the file: 0");
        assertThat(dialog.locator("button[type=submit]")).isDisabled();
    }

    @Test
    void showsOfTopicsWhatWasMeasuredAndFoldsTheGroupsOfReplays() {
        farm.hasRobot(1)
                .answers("/api/topics", "[{\"name\": \"data.raw\", \"written\": 1}]")
                .answers("/api/platform", """
                        {"controlPlane": {"parts": {}}, "deadLetters": [], "groups": [{"group": "furrow-ingest", "lag": 0}, {"group": "furrow-collision-of-weeding.3ef2c290", "lag": 0}]}""");
        FarmPage page = farm.open("#/topics", 1440, 900);
        page.find("[id='topic-data.raw']").check();
        assertThat(page.find("furrow-topics td.value").first()).containsText("{\"Domain\":\"farm\"");

        page.go("Platform");
        Locator groups = page.find("furrow-platform").getByText("furrow-");
        assertThat(groups.filter(new Locator.FilterOptions().setVisible(true))).hasText(new String[] {"furrow-ingest"});
        page.find("furrow-platform summary").click();
        assertThat(groups.filter(new Locator.FilterOptions().setVisible(true))).hasCount(2);
    }

    /** No table of missions, replays and analyses is wider than its place. */
    @Test
    void fitsTablesOnATablet() {
        long now = System.currentTimeMillis();
        farm.answers("/api/missions", "[{\"mission\": \"weeding\", \"domain\": \"farm\", \"running\": true}]")
                .answers("/api/missions/weeding", "{\"mission\": \"weeding\", \"domain\": \"farm\", \"running\": true}")
                .answers("/api/devices", """
                        [{"id": "urn:ngsi-ld:Thermometer:weeding-12", "wanted": "running", "status": {"state": "running"}, "health": {"heard": %d, "battery": 0.5}}]""".formatted(now - 3_000))
                .answers(
                        "/api/recordings",
                        "[{\"mission\": \"weeding\", \"first\": %d, \"last\": %d}]".formatted(now - MINUTE, now))
                .answers("/api/history/data.collision", """
                        {"since": 0, "records": [{"topic": "data.collision", "kind": "event", "key": "e", "time": %1$d, "headers": {}, "value": {"type": "Analytics:Collision",
                          "encounter": {"value": "e"}, "phase": {"value": "ended"}, "time": {"value": %1$d}, "minDistance": {"value": 3},
                          "Device1_ID": {"value": "urn:ngsi-ld:Robot:weeding-1"}, "Device2_ID": {"value": "urn:ngsi-ld:Robot:weeding-2"}}}]}""".formatted(now - MINUTE));
        for (int width : new int[] {1024, 768}) {
            FarmPage page = farm.open("#/missions", width, 768);
            fits(page, ".device-table");
            page.go("Replays");
            fits(page, "furrow-replays .table-frame");
            page.go("Analyses");
            fits(page, ".encounter-frame");
        }
    }

    private static void fits(FarmPage page, String table) {
        assertThat(page.find(table)).isVisible();
        assertThat(((Number) page.find(table).evaluate("(frame) => frame.scrollWidth - frame.clientWidth")).intValue())
                .as(table)
                .isZero();
    }
}
