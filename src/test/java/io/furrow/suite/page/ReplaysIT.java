package io.furrow.suite.page;

import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.options.AriaRole;
import com.microsoft.playwright.options.BoundingBox;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.EXACTLY;

/** Replays of recorded missions. */
@PageTest
@Tag("full")
class ReplaysIT {
    /** Topics of a replay's results are created with the first result. */
    static final String NO_RESULTS_YET = "status of 404.*\\.replay\\.\\w+";

    private static final String ROBOT = "urn:ngsi-ld:Robot:1";

    @Test
    void playsPausesSeeksStepsAndReturnsToLive(PageSuite suite) {
        FarmPage farm = suite.open("#/replays").expectingError(NO_RESULTS_YET);
        start(farm);

        assertThat(farm.find(".mode")).containsText("Replay of weeding");
        assertThat(farm.find("furrow-app")).hasClass(Pattern.compile("replaying"));
        assertThat(farm.card(ROBOT)).containsText("recorded, not sent");
        assertThat(farm.card(ROBOT).getByText("Stop", EXACTLY)).isDisabled();

        farm.untilStore("store.mode.state === 'running' && store.mode.position > store.mode.from");
        farm.find("body").press(" ");
        farm.untilStore("store.mode.state === 'paused'");

        BoundingBox track = farm.find("furrow-timeline .tl-track").boundingBox();
        double middle = middle(farm);
        farm.page().mouse().click(track.x + track.width / 2, track.y + track.height / 2);
        farm.untilStore("Math.abs(store.mode.position - " + middle + ") < 3000");
        // Each card shows its state at that position: the newest report up to then.
        farm.untilStore("store.entities.get('" + ROBOT + "')?.time < store.mode.position + 1000 && store.entities.get('"
                + ROBOT + "').time > store.mode.position - 30000");
        assertThat(farm.card("urn:ngsi-ld:Thermometer:4")).containsText("40.5 °C");

        double before = position(farm);
        farm.find("body").press("ArrowRight");
        farm.until(() -> position(farm) > before);
        double after = position(farm);
        farm.find("body").press("ArrowLeft");
        farm.until(() -> position(farm) < after);

        farm.button("Back to live").click();
        assertThat(farm.find(".mode")).hasText("Live");
        farm.untilStore("Math.abs(store.entities.get('" + ROBOT + "')?.time - Date.now()) < 5000");
        assertThat(farm.card(ROBOT)).not().containsText("recorded, not sent");
    }

    @Test
    void loopsARangeThatBracketsSet(PageSuite suite) {
        FarmPage farm = suite.open("#/replays").expectingError(NO_RESULTS_YET);
        start(farm);
        farm.untilStore("store.mode.state === 'running' && store.mode.position > store.mode.from + 1000");
        farm.find("body").press(" ");
        farm.untilStore("store.mode.state === 'paused'");

        farm.find("body").press("[");
        farm.untilStore("store.mode.range !== null && store.mode.range !== undefined");
        assertThat(farm.button("Loop")).hasAttribute("aria-pressed", "true");
        farm.find("body").press("Shift+ArrowRight");
        double from = position(farm);
        farm.find("body").press("]");
        farm.untilStore("store.mode.range.to - store.mode.range.from < 15000");
        farm.find("body").press(" ");
        farm.untilStore(
                "store.mode.epoch > 1 && store.mode.position <= store.mode.range.to + 1000 && store.mode.position >= store.mode.range.from - 1000");
        Assertions.assertThat(from).isPositive();
    }

    @Test
    void opensAMomentByALink(PageSuite suite) {
        FarmPage farm = suite.open("#/replays").expectingError(NO_RESULTS_YET);
        start(farm);
        farm.untilStore("store.mode.position > store.mode.from");
        List<?> moment = (List<?>)
                farm.store("[store.mode.replay, new Date((store.mode.from + store.mode.to) / 2).toISOString()]");

        FarmPage other = suite.open("#/map?replay=" + moment.get(0) + "&at=" + moment.get(1))
                .expectingError(NO_RESULTS_YET);
        assertThat(other.find(".mode")).containsText("Replay of weeding");
        other.untilStore("Math.abs(store.mode.position - Date.parse('" + moment.get(1) + "')) < 15000");
    }

    @Test
    void playsTwoMissionsOnOneClock(PageSuite suite) {
        FarmPage farm = suite.open("#/replays").expectingError(NO_RESULTS_YET);
        awaitRecorded(farm, "weeding");
        awaitRecorded(farm, "scouting");
        farm.page().getByLabel("Choose weeding").check();
        farm.page().getByLabel("Choose scouting").check();
        farm.button("Start replay").click();

        assertThat(farm.find(".mode")).containsText(Pattern.compile("weeding \\+ scouting|scouting \\+ weeding"));
        assertThat(farm.card(ROBOT)).isAttached();
        assertThat(farm.card("urn:ngsi-ld:Camera:1")).isAttached();
    }

    /**
     * The hour at the end of summer time occurs twice: the last event is at 02:40 local time, as early as or even
     * before the first one.
     */
    @Test
    void plansAWholeMissionAcrossTheEndOfSummerTime(PageSuite suite) {
        FarmPage farm = suite.window();
        farm.page()
                .route(
                        "**/api/recordings",
                        route -> route.fulfill(new Route.FulfillOptions()
                                .setContentType("application/json")
                                .setBody("""
                [{"mission": "long", "first": 1792887000000, "last": 1792892400000},
                 {"mission": "short", "first": 1792889400000, "last": 1792890600000}]""")));
        List<String> plans = new ArrayList<>();
        farm.page().route("**/api/replays", route -> {
            plans.add(route.request().postData());
            route.abort();
        });
        // these missions were not recorded
        farm.expectingError("ERR_FAILED").expectingError("/timeline\\?").open("#/replays?mission=long");

        assertThat(farm.find(".plan")).containsText("Length: 90 min");
        farm.button("Start replay").click();
        farm.until(() -> plans.size() == 1);

        farm.page().getByLabel("Choose long").uncheck();
        farm.page().getByLabel("Choose short").check();
        assertThat(farm.find(".plan")).containsText("Length: 20 min");
        farm.button("Start replay").click();
        farm.until(() -> plans.size() == 2);
        Assertions.assertThat(plans).noneMatch(plan -> plan.contains("\"from\"") || plan.contains("\"to\""));

        farm.find("#plan-to").fill("2026-10-25T02:05");
        farm.button("Start replay").click();
        farm.until(() -> plans.size() == 3);
        Assertions.assertThat(plans.get(2)).contains("\"to\":1792890300000").doesNotContain("\"from\"");
    }

    /** The status is deleted some time after the replay. */
    @Test
    void isOverUntilItsStatusIsDeleted(PageSuite suite) {
        FarmPage farm = suite.open("").expectingError(NO_RESULTS_YET);
        farm.untilStore("store.primed");
        Object states = farm.store("""
                (() => {
                  const of = { replay: 'r1', mission: 'weeding', topic: 'data.weeding.replay.00000001' };
                  const timeline = document.querySelector('furrow-timeline');
                  store.feeds.applyReplay({ key: 'r1', value: of });
                  store.feeds.applyStatus({ key: 'r1', time: 1, value: { state: 'running' } });
                  store.enterReplay(of);
                  const states = [timeline.state];
                  store.feeds.applyReplay({ key: 'r1', value: null });
                  store.feeds.applyStatus({ key: 'r1', time: 2, value: { state: 'stopped' } });
                  states.push(timeline.state);
                  store.feeds.applyStatus({ key: 'r1', value: null });
                  states.push(timeline.state);
                  store.leaveReplay();
                  return states.join();
                })()""");

        Assertions.assertThat(states).isEqualTo("running,over,over");
    }

    private static void start(FarmPage farm) {
        awaitRecorded(farm, "weeding");
        farm.page().getByLabel("Choose weeding").check();
        farm.page().getByLabel("Speed").first().selectOption("1");
        farm.button("Start replay").click();
        assertThat(farm.page()).hasURL(Pattern.compile("#/map"));
    }

    private static void awaitRecorded(FarmPage farm, String mission) {
        farm.untilStore("store.recordings.get('" + mission + "')?.last - store.recordings.get('" + mission
                + "')?.first > 20000");
        assertThat(farm.find("table.recordings")
                        .getByRole(AriaRole.CHECKBOX, new Locator.GetByRoleOptions().setName("Choose " + mission)))
                .isVisible();
    }

    /** The middle of the times that the timeline shows, which grows while the mission continues. */
    private static double middle(FarmPage farm) {
        Object time = farm.run(
                "() => { const { from, to } = document.querySelector('furrow-timeline').scale; return (from + to) / 2; }");
        return ((Number) time).doubleValue();
    }

    private static double position(FarmPage farm) {
        return ((Number) farm.store("store.mode.position")).doubleValue();
    }
}
