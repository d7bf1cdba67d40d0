package io.furrow.suite.page;

import java.util.List;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The page on a farm that has more than the demonstration: many alarms and silent devices, in windows of all sizes. */
class CrowdedFarmIT {
    private static final String ROBOT = "urn:ngsi-ld:Robot:";
    private static final long HOUR = 3_600_000;

    @AutoClose
    private StubFarm farm;

    @BeforeEach
    void start() throws Exception {
        farm = new StubFarm().hasRobot(1).hasRobot(2).hasRobot(3);
    }

    @Test
    void movesNothingUnderAHandWhenAlarmsOpenAndClose() {
        FarmPage page = farm.open("", 1440, 900);
        Locator stop = page.card(ROBOT + 2).locator(".button.primary");
        stop.hover();
        double place = stop.boundingBox().y;

        for (int alarm = 1; alarm <= 30; alarm++) {
            farm.send("service.alarms", "a" + alarm, alarm(alarm, "critical", "open"));
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

    @Test
    void leavesThePlaceOfAnAlarmEmptyWhileThePointerIsOnTheList() {
        for (int alarm = 1; alarm <= 3; alarm++) {
            farm.has("service.alarms", "a" + alarm, alarm(alarm, "warning", "open"));
        }
        FarmPage page = farm.open("", 1440, 900);
        Locator second = page.find("furrow-alarms > .alarm-list > li.alarm").nth(1);
        second.getByText("Acknowledge").hover();
        double place = second.boundingBox().y;
        String name = second.locator(".alarm-text").textContent();
        farm.send("service.alarms", "a0", alarm(0, "critical", "open"));
        farm.send("service.alarms", "a1", alarm(1, "warning", "closed"));

        assertThat(page.find("furrow-alarms .alarm-gap")).hasCount(1);
        assertThat(page.find("furrow-alarms li.alarm").filter(FarmPage.having(name)).boundingBox().y).isEqualTo(place);
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
        farm.send("data.raw", ROBOT + 1, StubFarm.robot(1, "Stopped").replace("\"cmd\"", "\"cmd_status\": {\"value\": \"OK\"}, \"cmd\""));
        assertThat(rows.nth(0)).containsText("✓ Stop");
        assertThat(rows.nth(2)).containsText("no answer yet");
        assertThat(farm.sent()).hasSize(3).allMatch(each -> each.endsWith("{\"command\":\"Stop\",\"type\":\"ROBOT\"}"));
    }

    @Test
    void showsDevicesThatWorkBeforeSilentOnesAndTheSelectedOneAlways() {
        for (int number = 10; number < 60; number++) {
            farm.has("data.raw", ROBOT + number, StubFarm.robot(number, "Running"), System.currentTimeMillis() - HOUR);
        }
        farm.answers("/api/devices", "[{\"id\": \"" + ROBOT + "12\", \"type\": \"Robot\", \"wanted\": \"stopped\"}]");
        FarmPage page = farm.open("", 1440, 900);
        Locator cards = page.find("furrow-cards li.card.device");
        assertThat(page.find(".card-fold")).hasText("50 devices silent or off");
        assertThat(cards).hasCount(3);

        page.store("store.select('" + ROBOT + "12')");
        assertThat(page.card(ROBOT + 12)).hasClass(Pattern.compile("is-off"));
        assertThat(page.card(ROBOT + 12).locator(".button.primary")).hasCount(0);
        page.find(".card-fold").click();
        page.find("furrow-cards").evaluate("(cards) => { cards.scrollTop = 1e6; }");
        assertThat(page.card(ROBOT + 12).locator(".card-name")).isInViewport();
        page.find("furrow-cards").evaluate("(cards) => { cards.scrollTop = 0; }");
        assertThat(page.card(ROBOT + 12).locator(".card-name")).isInViewport();
    }

    /** The last two are the window of the first at 200 and 400 %. */
    @ParameterizedTest
    @CsvSource({"1440, 900", "390, 844", "740, 360", "720, 450", "360, 225"})
    void reachesEverythingInWindowsOfAllSizes(int width, int height) {
        for (int alarm = 1; alarm <= 25; alarm++) {
            farm.has("service.alarms", "a" + alarm, alarm(alarm, "warning", "open"));
        }
        FarmPage page = farm.open("", width, height);
        assertThat(page.find("furrow-cards li.card.device")).hasCount(3);

        for (String selector : List.of(
                ".rail a[data-view=platform]", "furrow-alarms .button:text('Acknowledge') >> nth=-1", "furrow-cards .button.primary >> nth=-1",
                ".stop-all", ".map-controls .button >> nth=-1")) {
            page.find(selector).click(new Locator.ClickOptions().setTrial(true));
            assertThat(page.find(selector)).isInViewport();
        }
        assertThat(page.is("document.documentElement.scrollWidth <= innerWidth")).isTrue();
        page.go("Missions");
        assertThat(page.find("furrow-missions .empty .button")).isVisible();
    }

    private static String alarm(int number, String severity, String state) {
        return """
                {"alarm": "a%d", "kind": "silent-device", "severity": "%s", "text": "Thermometer %d is silent", "subject": "t", "raised": %d, "count": 1, "state": "%s"}""".formatted(number, severity, number, 1_000_000 - number, state);
    }
}
