package io.furrow.suite.page;

import java.time.Instant;
import java.util.List;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The page on a farm that has more than the demonstration: many alarms and silent devices, in windows of all sizes. */
class CrowdedFarmIT extends StubbedPage {
    private static final String ROBOT = "urn:ngsi-ld:Robot:";
    private static final long HOUR = 3_600_000;
    private static final long MINUTE = 60_000;
    /** Event time of replays. */
    private static final long START = Instant.parse("2026-01-01T03:04:30Z").toEpochMilli();

    private static final String LONGITUDE =
            "ol.proj.toLonLat(document.querySelector('furrow-map').view.getCenter())[0]";
    private static final String RESOLUTION = "document.querySelector('furrow-map').view?.getResolution() ?? 1e9";

    /** A click of a test scrolls what a hand cannot scroll. */
    private static final String NOTHING_CUT =
            "[...document.querySelectorAll('furrow-app, .side')].every((each) => getComputedStyle(each).overflowY !== 'hidden' || each.scrollHeight <= each.clientHeight)";

    @BeforeEach
    void start() {
        farm.hasRobot(1).hasRobot(2).hasRobot(3);
    }

    @Test
    void movesNothingUnderAHandWhenAlarmsOpenAndClose() {
        FarmPage page = farm.open("", 1440, 900);
        Locator stop = page.card(ROBOT + 2).locator(".button.primary");
        stop.hover();
        double place = stop.boundingBox().y;

        for (int alarm = 1; alarm <= 30; alarm++) {
            farm.send("service.alarms", "a" + alarm, StubFarm.alarm(alarm, "critical", "open"));
        }
        assertThat(page.find("furrow-alarms h2")).containsText("30 open");
        assertThat(stop.boundingBox().y).isEqualTo(place);

        page.page().mouse().move(300, 300);
        assertThat(page.find("furrow-alarms")).hasAttribute("data-room", "many");
        assertThat(stop).isInViewport();
        assertThat(page.find("furrow-alarms > .alarm-list > li.alarm")).hasCount(20);
        page.button("Show 10 more").click();
        assertThat(page.find("furrow-alarms > .alarm-list > li.alarm")).hasCount(30);
    }

    @Tag("full")
    @Test
    void leavesThePlaceOfAnAlarmEmptyWhileThePointerIsOnTheList() {
        farm.hasAlarms(3);
        FarmPage page = farm.open("", 1440, 900);
        Locator second = page.find("furrow-alarms > .alarm-list > li.alarm").nth(1);
        second.getByText("Acknowledge").hover();
        double place = second.boundingBox().y;
        String name = second.locator(".alarm-text").textContent();
        farm.send("service.alarms", "a0", StubFarm.alarm(0, "critical", "open"));
        farm.send("service.alarms", "a1", StubFarm.alarm(1, "warning", "closed"));

        assertThat(page.find("furrow-alarms .alarm-gap")).hasCount(1);
        assertThat(page.find("furrow-alarms li.alarm")
                        .filter(FarmPage.having(name))
                        .boundingBox()
                        .y)
                .isEqualTo(place);
        page.page().mouse().move(300, 300);
        assertThat(page.find("furrow-alarms li.alarm").first()).hasClass(Pattern.compile("critical"));
        assertThat(page.find("furrow-alarms .alarm-gap")).hasCount(0);
    }

    @Test
    void stopsAllRobotsAndShowsTheOutcomeOfEach() {
        farm.answers("/api/devices/" + ROBOT + "2/commands", "503");
        FarmPage page = farm.open("", 1440, 900).expectingError("status of 503");
        page.untilStore("store.entities.size === 3");
        page.button("Stop all robots").click();
        assertThat(farm.sent()).isEmpty();
        page.page().keyboard().press("Enter");

        Locator rows = page.find(".stop-list li");
        assertThat(rows).hasCount(3);
        assertThat(rows.nth(1)).containsText("the stub rejects it");
        farm.send(
                "data.raw",
                ROBOT + 1,
                StubFarm.robot(1, "Stopped").replace("\"cmd\"", "\"cmd_status\": {\"value\": \"OK\"}, \"cmd\""));
        assertThat(rows.nth(0)).containsText("✓ Stop");
        assertThat(rows.nth(2)).containsText("no answer yet");
        assertThat(farm.sent()).hasSize(3).allMatch(each -> each.endsWith("{\"command\":\"Stop\",\"type\":\"ROBOT\"}"));
    }

    @Tag("full")
    @Test
    void showsDevicesThatWorkBeforeSilentOnesAndTheSelectedOneAlways() {
        for (int number = 10; number < 60; number++) {
            farm.has("data.raw", ROBOT + number, StubFarm.robot(number, "Running"), System.currentTimeMillis() - HOUR);
        }
        farm.answers("/api/devices", "[{\"id\": \"" + ROBOT + "12\", \"type\": \"Robot\", \"wanted\": \"stopped\"}]");
        farm.has("data.raw", ROBOT + 4, StubFarm.robot(4, "Error"));
        FarmPage page = farm.open("", 1440, 900);
        Locator names = page.find("furrow-cards li.card.device .card-name");
        assertThat(page.find(".card-fold")).hasText("50 devices silent or off");
        assertThat(names).hasText(new String[] {"Robot 4", "Robot 1", "Robot 2", "Robot 3"});

        page.store("store.select('" + ROBOT + "12')");
        assertThat(page.card(ROBOT + 12)).hasClass(Pattern.compile("is-off"));
        assertThat(page.card(ROBOT + 12).locator(".button.primary")).hasCount(0);
        page.find(".card-fold").click();
        assertThat(names.nth(3)).hasText("Robot 3");
        assertThat(names.nth(4)).hasText("Robot 10");
        page.find("furrow-cards").evaluate("(cards) => { cards.scrollTop = 1e6; }");
        assertThat(page.card(ROBOT + 12).locator(".card-name")).isInViewport();
        page.find("furrow-cards").evaluate("(cards) => { cards.scrollTop = 0; }");
        assertThat(page.card(ROBOT + 12).locator(".card-name")).isInViewport();
    }

    /** The last two are the window of the first at 200 and 400 %. */
    @Tag("full")
    @ParameterizedTest
    @CsvSource({"1440, 900", "390, 844", "740, 360", "720, 450", "360, 225"})
    void reachesEverythingInWindowsOfAllSizes(int width, int height) {
        farm.hasAlarms(25);
        FarmPage page = farm.open("", width, height);
        assertThat(page.find("furrow-cards li.card.device")).hasCount(3);

        for (String selector : List.of(
                ".rail a[data-view=platform]",
                "furrow-alarms .button:text('Acknowledge') >> nth=-1",
                "furrow-cards .button.primary >> nth=-1",
                ".stop-all",
                ".map-controls > .button >> nth=-1")) {
            page.find(selector).click(new Locator.ClickOptions().setTrial(true));
            assertThat(page.find(selector)).isInViewport();
        }
        assertThat(page.find("furrow-cards li.card.device").first().boundingBox().width)
                .isGreaterThan(200);
        assertThat(page.is("document.documentElement.scrollWidth <= innerWidth"))
                .isTrue();
        assertThat(page.is(NOTHING_CUT)).isTrue();
        page.go("Missions");
        assertThat(page.find("furrow-missions .empty .button")).isVisible();
    }

    @Tag("full")
    @Test
    void marksAReplayOnlyWhereItIsShown() {
        farm.hasAlarms(1);
        farm.hasReplay("weeding", "", "paused", START, START + MINUTE, START + MINUTE / 2);
        FarmPage page = farm.open("#/map?replay=weeding.1", 1440, 900);
        assertThat(page.find(".mode")).containsText("Replay of weeding");
        assertThat(page.find(".now")).containsText("04:05");
        assertThat(page.find("furrow-alarms summary")).hasText("Live, not from the replay: 1 alarm");
        assertThat(page.find("furrow-alarms > .alarm-list > li.alarm")).hasCount(0);

        page.go("Missions");
        assertThat(page.find(".mode")).hasText("Live");
        assertThat(page.find("furrow-app")).not().hasClass(Pattern.compile("replaying"));
        assertThat(page.find(".live-note")).containsText("This view is live. The map shows a replay of weeding.");
        assertThat(page.find(".now")).not().containsText("04:05");
        page.find(".live-note a").click();
        assertThat(page.find("furrow-app")).hasClass(Pattern.compile("replaying"));
        assertThat(page.find(".live-note")).isHidden();
    }

    @Tag("full")
    @Test
    void fitsTheFarmInScopeAndOffersTheOthers() {
        farm.hasField("near", "farm", -3.4835, 40.3125).hasField("far", "alps", 10.2, 47.1);
        FarmPage page = farm.open("", 1440, 900);
        Locator chips = page.find(".map-farms .chip");
        assertThat(chips).hasText(new String[] {"farm", "alps"});
        assertThat(chips.first()).hasAttribute("aria-pressed", "true");
        page.until(() -> Math.abs(page.number(LONGITUDE) + 3.48) < 0.01 && page.number(RESOLUTION) < 1);

        chips.last().click();
        page.until(() -> Math.abs(page.number(LONGITUDE) - 10.2) < 0.01);
        page.store("store.setScope({ domain: 'farm' })");
        page.until(() -> Math.abs(page.number(LONGITUDE) + 3.48) < 0.01);
        assertThat(chips).hasCount(0);

        page.page().setViewportSize(844, 390);
        FarmPage fresh = farm.open("", 844, 390);
        fresh.store("store.setScope({ domain: 'farm' })");
        fresh.until(() -> fresh.number(RESOLUTION) < 1);
        page.until(() -> page.number(RESOLUTION) == fresh.number(RESOLUTION));
    }

    /** Each of its replays has the devices of one mission: an encounter between them was found while they were recorded. */
    @Tag("full")
    @Test
    void showsAGroupOfReplaysAsAGroup() {
        farm.hasReplay("weeding", "g", "paused", START, START + MINUTE, START + MINUTE / 2);
        farm.hasReplay("scouting", "g", "paused", START - MINUTE, START + 2 * MINUTE, START + MINUTE / 2);
        farm.answers("/api/history/data.collision", """
                {"since": 0, "records": [{"topic": "data.collision", "kind": "event", "key": "e", "time": %1$d, "headers": {}, "value": {"type": "Analytics:Collision",
                  "encounter": {"value": "e"}, "phase": {"value": "ended"}, "startTime": {"value": %2$d}, "time": {"value": %1$d}, "minDistance": {"value": 3},
                  "Device1_ID": {"value": "urn:ngsi-ld:Robot:1"}, "Device1_Mission": {"value": "weeding"},
                  "Device2_ID": {"value": "urn:ngsi-ld:Robot:2"}, "Device2_Mission": {"value": "scouting"}}}]}""".formatted(START + 40_000, START + 20_000));
        FarmPage page = farm.open("#/map?replay=weeding.1", 1440, 900);
        page.untilStore(
                "[...store.encounters.values()].some((each) => each.phase === 'ongoing' && each.minDistance === 3)");

        page.go("Replays");
        assertThat(page.find(".running")).containsText("1:30 of 3:00");
        page.go("Analyses");
        assertThat(page.find("furrow-analyses .encounters tbody tr")).hasCount(1);
    }

    /** With status 500, and without an answer. */
    @Tag("full")
    @ParameterizedTest
    @ValueSource(strings = {"500", ""})
    void saysThatNothingIsThereOnlyIfItIsKnown(String answer) {
        List.of(
                        "/api/domains",
                        "/api/recordings",
                        "/api/register/service.fields",
                        "/api/register/service.replays",
                        "/api/register/service.alarms")
                .forEach(each -> farm.answers(each, answer));
        FarmPage page = farm.open("#/missions?tab=domains", 1440, 900).expectingError("status of 500");
        assertThat(page.find("#missions-panel").locator(answer.isEmpty() ? ".list-skeleton" : ".error-note:visible"))
                .hasCount(answer.isEmpty() ? 6 : 2);
        assertThat(page.find("#missions-panel .empty")).hasCount(0);
        page.go("Replays");
        assertThat(page.find("furrow-replays").locator(answer.isEmpty() ? ".list-skeleton" : ".error-note:visible"))
                .hasCount(answer.isEmpty() ? 6 : 2);
        assertThat(page.find("furrow-replays .empty")).hasCount(0);
        page.go("Map");
        assertThat(page.find(".alarm-none"))
                .containsText(answer.isEmpty() ? "being read" : "cannot be read: the stub rejects it");
    }
}
