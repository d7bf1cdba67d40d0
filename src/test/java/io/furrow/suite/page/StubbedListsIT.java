package io.furrow.suite.page;

import java.net.URI;
import java.time.Instant;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.stream.IntStream;

import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** Lists and forms of views: their order, their length and their times. */
@Tag("full")
class StubbedListsIT extends StubbedPage {
    private static final long START = Instant.parse("2026-01-01T03:04:30Z").toEpochMilli();
    private static final int MANY = 60;

    /** Not in the language and on the clock of the browser, as in its own input of a time. */
    @Test
    void writesTheTimesOfAReplayOnTheClockOfThePage() {
        farm.answers(
                "/api/recordings",
                "[{\"mission\": \"weeding\", \"first\": %d, \"last\": %d}]".formatted(START, START + 600_000));
        FarmPage page = farm.open("#/replays", 1440, 900);
        page.page().getByLabel("Choose weeding").check();
        assertThat(page.find("#plan-from")).hasValue("2026-01-01 04:04:30");

        page.find("#plan-from").fill("2026-01-01 04:09");
        assertThat(page.find(".plan")).containsText("Length: 5 min");
        page.find("#plan-from").fill("1/1/2026, 4:09 AM");
        assertThat(page.button("Start replay")).isDisabled();
    }

    /** The topics of results are created with their first record. */
    @Test
    void requestsNoResultsOfAFarmWithoutAny() {
        FarmPage page = farm.open("#/analyses", 1440, 900);
        List<String> requested = new CopyOnWriteArrayList<>();
        page.page().onRequest(request -> requested.add(URI.create(request.url()).getPath()));
        page.page().reload();
        assertThat(page.find("furrow-analyses .encounters .empty")).isVisible();
        page.until(() -> requested.contains("/api/register/data.raw"));
        assertThat(requested)
                .contains("/api/topics")
                .noneMatch(each -> each.matches("/api/(register|history)/data\\.(collision|temperature|images)"));

        farm.has("data.images", "c", "{\"entity\": \"c\", \"sha256\": \"0\"}");
        page.until(() -> requested.contains("/api/register/data.images"));
    }

    /** Each row is a stop of the keyboard. */
    @Test
    void showsEncountersInPortions() {
        farm.answers(
                "/api/history/data.collision",
                "{\"since\": 0, \"records\": "
                        + IntStream.range(0, MANY)
                                .mapToObj(StubbedListsIT::encounter)
                                .toList() + "}");
        FarmPage page = farm.open("#/analyses", 1440, 900);
        Locator rows = page.find(".encounter-frame tbody tr");
        assertThat(rows).hasCount(25);

        page.button("25 of 60 are shown: show more").click();
        assertThat(rows).hasCount(MANY);
        assertThat(page.button("25 of 60 are shown: show more")).hasCount(0);
    }

    private static String encounter(int number) {
        return """
                {"topic": "data.collision", "kind": "event", "key": "e%1$d", "time": %2$d, "headers": {}, "value": {"type": "Analytics:Collision", "encounter": {"value": "e%1$d"},
                 "phase": {"value": "ended"}, "time": {"value": %2$d}, "minDistance": {"value": 3}, "Device1_ID": {"value": "a"}, "Device2_ID": {"value": "b"}}}""".formatted(number, System.currentTimeMillis() - number * 1_000L);
    }

    @Test
    void leavesTheChosenMissionAtItsPlaceWhenItIsStopped() {
        farm.answers("/api/missions", missions("running")).answers("/api/missions/mowing", "{\"mission\": \"mowing\"}");
        FarmPage page = farm.open("#/missions?mission=mowing", 1440, 900);
        Locator names = page.find(".mission-row strong");
        assertThat(names).hasText(new String[] {"mowing", "weeding", "scouting"});

        farm.answers("/api/missions", missions("stopped"));
        farm.send("service.missions.status", "mowing", "{}");
        assertThat(page.find(".mission-row").first()).containsText("stopped");
        assertThat(names).hasText(new String[] {"mowing", "weeding", "scouting"});
    }

    private static String missions(String state) {
        String mission = "{\"mission\": \"%s\", \"domain\": \"farm\", \"status\": {\"state\": \"%s\"}}";
        return List.of(
                        mission.formatted("mowing", state),
                        mission.formatted("scouting", "stopped"),
                        mission.formatted("weeding", "running"))
                .toString();
    }

    @Test
    void reachesTheTimelineWithoutPassingAllCards() {
        FarmPage page = farm.open("", 1440, 900);
        assertThat(page.find(".tl-track")).isVisible();
        page.page().getByText("Skip to timeline").press("Enter");

        assertThat(page.find(".tl-track")).isFocused();
    }

    @Test
    void readsTheLengthOfACommandedMission() {
        farm.answers("/api/audit", """
                [{"time": 1, "user": "olga", "target": "service.missionmanager", "command": "start", "about": {"mission": "weeding", "duration": "PT1H30M"}, "result": "started"}]""");
        FarmPage page = farm.open("#/missions?tab=audit", 1440, 900);

        assertThat(page.find(".audit-table td.about")).hasText("weeding · duration 90 min");
    }

    /** Else it would be folded with its outcome. */
    @Test
    void leavesADeviceWithACommandAtItsPlace() {
        farm.hasRobot(1).hasRobot(2);
        FarmPage page = farm.open("", 1440, 900);
        Locator names = page.find("furrow-cards .card-name");
        page.button("Stop: Robot 1").click();
        page.page().mouse().move(720, 450);

        farm.send("data.raw", "urn:ngsi-ld:Robot:1", StubFarm.robot(1, "off"));
        farm.send("data.raw", "urn:ngsi-ld:Robot:3", StubFarm.robot(3, "Running"));
        assertThat(names).hasText(new String[] {"Robot 1", "Robot 2", "Robot 3"});
        assertThat(names.first().locator("xpath=ancestor::li").locator(".card-mark"))
                .hasText("off");
    }
}
