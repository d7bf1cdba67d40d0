package io.furrow.suite.page;

import java.net.URI;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** What the user looks at is in the address; and what the scope leaves out is said. */
@Tag("full")
class AddressIT extends StubbedPage {
    private static final long MINUTE = 60_000;
    private static final String ROBOT = "urn:ngsi-ld:Robot:";
    private static final String LATITUDE = "ol.proj.toLonLat(document.querySelector('furrow-map').view.getCenter())[1]";
    private static final Offset<Double> METER = Offset.offset(1e-5);

    @BeforeEach
    void start() {
        farm.hasRobot(1)
                .hasRobot(2)
                .has("data.raw", ROBOT + 3, StubFarm.robot(3, "Running"), System.currentTimeMillis() - 60 * MINUTE)
                .hasField("near", "farm", -3.4835, 40.3125)
                .hasField("far", "farm", 10.2, 47.1)
                .has(
                        "data.raw",
                        ROBOT + 9,
                        StubFarm.robot(9, "Running", "alps", "mowing", 47.1, 10.2),
                        System.currentTimeMillis() - 60 * MINUTE);
    }

    @Test
    void showsTheSameMapInAnotherWindow() {
        FarmPage page = farm.open("", 1440, 900);
        page.store("store.setScope({ domain: 'farm', mission: 'weeding' })");
        page.find(".map-farms .chip").last().click();
        page.until(() -> hash(page).contains("farm=far"));
        page.store("store.select('" + ROBOT + "2')");
        page.find("furrow-cards .chip").first().click();
        page.find(".map-controls .button").first().click();
        page.button("The map as a table").click();
        page.until(() -> hash(page).contains("table=1") && hash(page).contains("place="));
        page.find("input[type=search]").first().fill("robot");
        page.until(() -> hash(page).contains("find=robot"));

        FarmPage other = farm.open(hash(page), 1440, 900);
        for (FarmPage each : List.of(page, other)) {
            assertThat(each.find(".crumbs")).containsText("weeding");
            assertThat(each.card(ROBOT + 2)).hasClass(Pattern.compile("selected"));
            assertThat(each.find("furrow-cards .chip").first()).hasAttribute("aria-pressed", "true");
            assertThat(each.find(".map-farms .chip").last()).hasAttribute("aria-pressed", "true");
            assertThat(each.find(".map-table")).isVisible();
            assertThat(each.find("input[type=search]").first()).hasValue("robot");
        }
        assertThat(other.number(LATITUDE)).isCloseTo(page.number(LATITUDE), METER);
        assertThat(hash(other)).isEqualTo(hash(page));
    }

    @Test
    void removesFromTheAddressWhatIsNotChosenAnyMore() {
        FarmPage page = farm.open("#/map?scope=farm&select=" + ROBOT + "1&place=40.3125,-3.4822,18", 1440, 900);
        assertThat(page.card(ROBOT + 1)).hasClass(Pattern.compile("selected"));
        page.until(() -> page.is("Boolean(document.querySelector('furrow-map').view)"));
        assertThat(page.number(LATITUDE)).isCloseTo(40.3125, METER);
        page.store("store.select(null)");
        page.store("store.setScope({})");

        page.until(() -> hash(page).equals("#/map"));
    }

    @Test
    void keepsPeriodTablesAndTopicsOfAViewAndTheReplayOfAll() {
        long now = System.currentTimeMillis();
        farm.hasReplay("weeding", "", "paused", now - MINUTE, now, now - MINUTE / 2);
        FarmPage page = farm.open("#/map?replay=weeding.1", 1440, 900);
        assertThat(page.find(".mode")).containsText("Replay of weeding");
        page.go("Missions");
        assertThat(page.find(".live-note")).isVisible();
        page.page().reload();
        assertThat(page.find(".live-note")).containsText("The map shows a replay of weeding");

        FarmPage live = farm.open("#/analyses?period=15&tables=averages", 1440, 900);
        assertThat(live.find(".segments [aria-pressed=true]")).hasText("last 15 min");
        live.find(".segments .button").last().click();
        assertThat(live.find(".averages .button[aria-pressed=true]")).hasCount(1);
        live.until(() -> hash(live).equals("#/analyses?period=1440&tables=averages"));
        live.go("Topics");
        live.find("[id='topic-data.raw']").check();
        live.until(() -> hash(live).equals("#/topics?topic=data.raw"));
        live.page().reload();
        assertThat(live.find("[id='topic-data.raw']")).isChecked();
    }

    @Test
    void listsWhatIsInTheScopeAndCountsTheRest() {
        long now = System.currentTimeMillis();
        String recording = "{\"mission\": \"%s\", \"first\": %d, \"last\": %d}";
        farm.hasAlarms(1)
                .has("service.alarms", "b", """
                        {"alarm": "b", "kind": "silent-device", "severity": "critical", "text": "Robot 9 is silent", "subject": "x", "raised": 1, "count": 1, "state": "open",
                         "devices": [{"id": "urn:ngsi-ld:Robot:9", "type": "ROBOT"}]}""")
                .answers(
                        "/api/missions",
                        "[{\"mission\": \"weeding\", \"domain\": \"farm\"}, {\"mission\": \"mowing\", \"domain\": \"alps\"}]")
                .answers(
                        "/api/recordings",
                        "[" + recording.formatted("weeding", now - MINUTE, now) + ","
                                + recording.formatted("mowing", now - MINUTE, now) + "]")
                .has("data.farm.realtime", ROBOT + 1, StubFarm.robot(1, "Running"));
        FarmPage page = farm.open("", 1440, 900);
        Locator alarms = page.find("furrow-alarms li.alarm");
        assertThat(alarms).hasCount(2);
        List<String> requested = new ArrayList<>();
        page.page().onRequest(request -> requested.add(URI.create(request.url()).getPath()));
        page.store("store.setScope({ domain: 'farm' })");

        assertThat(alarms).hasCount(1);
        assertThat(page.find("furrow-alarms h2")).containsText("2 open");
        assertThat(page.button("1 outside of farm: show all")).isVisible();
        page.until(() -> requested.contains("/api/density/data.farm.realtime"));
        page.go("Missions");
        assertThat(page.find(".mission-row")).hasText(Pattern.compile("weeding"));
        page.go("Replays");
        assertThat(page.find(".recordings tbody tr")).hasText(Pattern.compile("weeding"));
        page.button("1 outside of farm: show all").click();
        assertThat(page.find(".recordings tbody tr")).hasCount(2);
        page.go("Missions");
        assertThat(page.find(".mission-row")).hasCount(2);
    }

    private static String hash(FarmPage page) {
        return String.valueOf(page.run("location.hash"));
    }
}
