package io.furrow.suite.page;

import java.time.Instant;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.assertions.LocatorAssertions;
import com.microsoft.playwright.options.AriaRole;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static java.nio.charset.StandardCharsets.UTF_8;

/** Alarms and their commands, announcements and notifications. */
@PageTest
class AlarmsIT {
    private static final String ANNOUNCEMENT = "New alarm, critical: Robot ";
    private static final String ROBOT = "urn:ngsi-ld:Robot:";
    private static final AtomicInteger NUMBERS = new AtomicInteger(1_000);
    private static final String ANNOUNCED = "furrow-alarms [aria-live=assertive]";
    private static final LocatorAssertions.ContainsTextOptions TIMEOUT =
            new LocatorAssertions.ContainsTextOptions().setTimeout(90_000);

    @Test
    void mutesAndAcknowledgesAnAlarm(PageSuite suite) throws Exception {
        FarmPage farm = suite.open("");
        Locator open = farm.find("furrow-alarms > .alarm-list > li.alarm").filter(suspect());
        Locator quiet = farm.find("furrow-alarms .alarm-fold li.alarm").filter(suspect());
        assertThat(open).hasCount(1);

        open.getByLabel("Mute or close").click();
        farm.button("Mute for 10 minutes").click();
        assertThat(open).hasCount(0);
        farm.find("furrow-alarms .alarm-fold summary").click();
        assertThat(quiet).containsText("muted until");
        quiet.getByLabel("Mute or close").click();
        farm.button("Unmute").click();
        assertThat(open).hasCount(1);

        open.getByText("Acknowledge").click();
        assertThat(open).hasCount(0);
        assertThat(quiet).isVisible();
        boolean acknowledged = false;
        for (JsonNode alarm : suite.rest("/api/alarms")) {
            acknowledged |= alarm.path("kind").asText().contains("suspect")
                    && alarm.path("state").asText().equals("acknowledged");
        }
        Assertions.assertThat(acknowledged).isTrue();
    }

    @Tag("full")
    @Test
    void reportsWhyAnAlarmCannotBeClosed(PageSuite suite) {
        FarmPage farm = suite.open("").expectingError("status of 4\\d\\d.*/close");
        String existing =
                "[...store.alarms.values()].find((each) => each.kind.includes('suspect') && each.state !== 'closed')?.alarm";
        farm.untilStore(existing + " !== undefined");
        Locator row = rowOf(farm, (String) farm.store(existing));

        close(row);

        assertThat(row.getByRole(AriaRole.ALERT)).containsText("closes when its cause is over");
    }

    /**
     * Uses an alarm of this window only and a mocked response, since the causes of real alarms last as long as the farm
     * runs.
     */
    @Tag("full")
    @Test
    void closesAnAlarm(FarmPage farm) {
        farm.untilStore("store.alarmsLoaded");
        AtomicInteger requested = new AtomicInteger();
        farm.page().route("**/api/alarms/over-1/close", route -> {
            requested.incrementAndGet();
            route.fulfill(new Route.FulfillOptions().setStatus(202));
        });
        applyAlarm(farm, "open");
        Locator row = rowOf(farm, "over-1");
        close(row);
        farm.until(() -> requested.get() == 1);

        applyAlarm(farm, "closed");
        assertThat(row).hasCount(0);
    }

    private static void applyAlarm(FarmPage farm, String state) {
        farm.run("""
                        async (state) => {
                          const { store } = await import('/core/store.js');
                          store.applyAlarm({ key: 'over-1', value: { alarm: 'over-1', kind: 'silent-device', severity: 'minor', text: 'the pump is silent',
                            subject: 'pump', raised: Date.now(), count: 1, state } });
                        }""", state);
    }

    private static Locator rowOf(FarmPage farm, String alarm) {
        farm.find("furrow-alarms .alarm-fold").evaluate("(fold) => { fold.open = true; }");
        return farm.find("furrow-alarms li.alarm:has([id='alarm-" + alarm + "'])");
    }

    private static void close(Locator row) {
        row.getByLabel("Mute or close").click();
        row.locator(".alarm-menu").getByText("Close").click();
    }

    @Tag("full")
    @Test
    void announcesANewAlarmToScreenReadersAndCountsIt(PageSuite suite) throws Exception {
        FarmPage farm = suite.open("");
        farm.untilStore("store.primed && store.alarmsLoaded");
        int robot = meet(suite);

        assertThat(farm.find(ANNOUNCED)).containsText(ANNOUNCEMENT + robot, TIMEOUT);
        assertThat(farm.find(".alarm-count")).hasAttribute("aria-label", Pattern.compile("[1-9]\\d* open alarms"));
        forget(suite, robot);
    }

    @Tag("full")
    @Test
    void findsAlarmsByTheirTexts(FarmPage farm) {
        Locator open = farm.find("furrow-alarms > .alarm-list > li.alarm");
        farm.untilStore("[...store.alarms.values()].some((each) => each.state === 'open')");
        Locator search = farm.page().getByRole(AriaRole.SEARCHBOX);

        search.fill("no such alarm");
        assertThat(farm.find(".alarm-none")).containsText("No open alarm matches the search.", TIMEOUT);
        assertThat(open).hasCount(0);
        search.fill("robot");
        assertThat(open.first()).containsText("Robot", TIMEOUT);
    }

    /** A hidden page closes its streams, except that of alarms. */
    @Tag("full")
    @Test
    void notifiesOfANewAlarmWhileThePageIsHidden(PageSuite suite) throws Exception {
        FarmPage farm = suite.window();
        farm.page().context().grantPermissions(List.of("notifications"));
        farm.page().addInitScript("""
                window.notified = [];
                window.Notification = class {
                  static permission = 'granted';
                  constructor(title, options) {
                    window.notified.push(`${title}: ${options.body}`);
                  }
                };""");
        AtomicInteger sockets = new AtomicInteger();
        farm.page().onWebSocket(socket -> {
            sockets.incrementAndGet();
            socket.onClose(closed -> sockets.decrementAndGet());
        });
        farm.open("");
        farm.untilStore("store.primed && store.alarmsLoaded");
        int robot = meet(suite);

        assertThat(farm.find(ANNOUNCED)).containsText(ANNOUNCEMENT + robot, TIMEOUT);
        Assertions.assertThat(farm.run("notified.length")).isEqualTo(0);

        farm.hide();
        farm.until(() -> sockets.get() == 1, FarmPage.TIMEOUT);
        int other = meet(suite);
        farm.until(
                () -> Boolean.TRUE.equals(farm.run(
                        "(robot) => notified.some((each) => each.startsWith(`Furrow: critical alarm: Robot ${robot}`))",
                        other)),
                FarmPage.TIMEOUT);
        forget(suite, robot);
        forget(suite, other);
    }

    /** Places two robots side by side, away from all others. @return the number of the first */
    private static int meet(PageSuite suite) throws Exception {
        int number = NUMBERS.getAndAdd(2);
        double latitude = 40.312 + (number - 1_000) * 5e-5;
        for (int each = number; each < number + 2; each++) {
            String id = ROBOT + each;
            suite.produce("data.raw", id, """
                    {"id": "%s", "type": "Robot", "Time": {"type": "Number", "value": %d},
                     "Latitude": {"type": "Number", "value": %s}, "Longitude": {"type": "Number", "value": -3.4822}}""".formatted(id, Instant.now().toEpochMilli(), latitude)
                    .getBytes(UTF_8));
        }
        return number;
    }

    private static void forget(PageSuite suite, int number) throws Exception {
        suite.forget(ROBOT + number);
        suite.forget(ROBOT + (number + 1));
    }

    private static Locator.FilterOptions suspect() {
        return new Locator.FilterOptions().setHasText("Thermometer 4");
    }
}
