package io.furrow.suite.page;

import java.time.Instant;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.assertions.LocatorAssertions;
import com.microsoft.playwright.options.AriaRole;
import com.microsoft.playwright.options.BoundingBox;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.ATTRIBUTES;
import static io.furrow.suite.page.FarmPage.EXACTLY;
import static java.nio.charset.StandardCharsets.UTF_8;

/** What a card says of its device, and what it does to it. */
@PageTest
class CardsIT {
    private static final String DEFECTIVE = "urn:ngsi-ld:Thermometer:4";
    private static final String STATION = "urn:ngsi-ld:WeatherStation:1";
    private static final String CAMERA = "urn:ngsi-ld:Camera:1";
    private static final String ROBOT = "urn:ngsi-ld:Robot:canary-1";

    @Tag("full")
    @Test
    void showsTheAttributesOfAnEntityWhateverTheyAre(FarmPage farm) {
        Locator card = farm.card(STATION);
        assertThat(card).containsText("°C");
        card.getByRole(AriaRole.BUTTON, ATTRIBUTES).click();

        for (String attribute : new String[] {"WindSpeed", "WindDirection", "Pressure", "SolarRadiation", "Humidity"}) {
            assertThat(card.locator(".attributes")).containsText(attribute);
        }
        assertThat(card.locator("svg.spark path")).hasAttribute("d", Pattern.compile("^M.*L.*"));
    }

    @Tag("full")
    @Test
    void reportsHowADeviceIsConnected(FarmPage farm) {
        farm.page()
                .route("**/api/devices/*Thermometer*", route -> route.fulfill(new Route.FulfillOptions().setBody("""
                {"connection": {
                  "refusedLogin": {"count": 12, "last": 1795705077000, "reason": "wrong-password", "user": "u"},
                  "unreadablePayload": {"count": 1, "last": 1795705077000, "reason": "no JSON", "payload": "<b>21</b>"},
                  "lastReport": {"time": 1795705070000, "received": 1795705069000, "offset": -1000},
                  "registered": false}}""")));
        Locator card = farm.card(DEFECTIVE);
        card.getByRole(AriaRole.BUTTON, ATTRIBUTES).click();

        assertThat(card.locator(".connection")).containsText(new Pattern[] {
            Pattern.compile("its clock is 1.0 s ahead"),
            Pattern.compile("The IoT Agent does not know it"),
            Pattern.compile("Its password was refused 12 times"),
            Pattern.compile("1 of its messages could not be read, the last at .*: no JSON. It began with <b>21</b>")
        });

        Locator station = farm.card(STATION);
        station.getByRole(AriaRole.BUTTON, ATTRIBUTES).click();
        assertThat(station.locator(".connection").first()).containsText("Last report of");
        assertThat(station.locator(".card-details")).containsText("Connected to the MQTT broker at");
    }

    /** From the measure over the stored mission to the chart, and from the stored image to the picture. */
    @Tag("full")
    @Test
    void leadsToWhatWasRecordedOfADevice(FarmPage farm) {
        LocatorAssertions.IsVisibleOptions recorded = new LocatorAssertions.IsVisibleOptions().setTimeout(90_000);
        farm.card(ROBOT).getByLabel("History of").click();
        assertThat(farm.find(".history-panel canvas")).isVisible(recorded);
        assertThat(farm.find(".history-panel")).containsText("m/s");

        farm.find("#history-device").selectOption(CAMERA);
        assertThat(farm.find(".history-picture img")).isVisible(recorded);
    }

    /** {@code data.latest} is behind {@code data.raw}, by a checkpoint where it is written exactly once. */
    @Tag("full")
    @Test
    void showsWhatWasReportedBeforeThePageWasOpenedAndIsNotMergedYet(FarmPage farm) {
        farm.untilStore("store.pastLoaded");
        farm.store("""
                store.applyPast([21.5, 22.5].map((value, index) => ({
                  topic: 'data.raw', kind: 'prime', key: 'urn:ngsi-ld:Thermometer:new', time: Date.now() - 1000 + index, headers: {},
                  value: { id: 'urn:ngsi-ld:Thermometer:new', type: 'Thermometer', Temperature: { type: 'Float', value } },
                })))""");

        assertThat(farm.card("urn:ngsi-ld:Thermometer:new")).containsText("22.5 °C");
        farm.store("""
                store.applyPast([{ id: 'gone', type: 'Thermometer' }, null].map((value, index) => (
                  { topic: 'data.raw', kind: 'prime', key: 'gone', time: Date.now() + index, headers: {}, value })))""");
        assertThat(farm.card("gone")).hasCount(0);
    }

    @Tag("full")
    @Test
    void takesOfALateReportWhatIsNotKnownNewerAndEachCommandState(FarmPage farm) {
        farm.untilStore("store.primed");
        Object taken = farm.store("""
                (() => {
                  const id = 'urn:ngsi-ld:Robot:late';
                  const report = (time, values) => store.applyEntity({ key: id, kind: 'event', time, headers: {},
                    value: { id, type: 'Robot', ...Object.fromEntries(Object.entries(values).map(([name, value]) => [name, { value }])) } });
                  report(2000, { speed: 2, Latitude: 40.31, Longitude: -3.48, cmd_status: 'PENDING' });
                  report(1000, { speed: 1, Latitude: 40.39, Longitude: -3.48, battery: 0.5, cmd_status: 'OK', constructor: 5 });
                  report(1500, { battery: 0.4 });
                  report(2000, { state: 'Stopped' });
                  report(2000, { state: 'Running' });
                  const { attributes, position, word } = store.entities.get(id);
                  store.applyEntity({ key: id, value: null });
                  return [...['speed', 'battery', 'cmd_status', 'constructor'].map((name) => attributes[name].value), position.join(), word].join(' ');
                })()""");

        Assertions.assertThat(taken).isEqualTo("2 0.4 OK 5 -3.48,40.31 Running");
    }

    @Tag("full")
    @Test
    void findsOutTheDefectiveThermometerAndPutsItFirst(FarmPage farm) {
        assertThat(farm.card(DEFECTIVE)).containsText("suspect");
        assertThat(farm.card(DEFECTIVE)).containsText("40.5 °C");
        assertThat(farm.card(DEFECTIVE)).containsText("Field mean");
        assertThat(farm.find("furrow-cards li.card.device").first())
                .hasAttribute("data-id", DEFECTIVE, new LocatorAssertions.HasAttributeOptions().setTimeout(10_000));
    }

    @Tag("full")
    @Test
    void showsTheStoredPictureOfACamera(FarmPage farm) {
        farm.card(CAMERA).scrollIntoViewIfNeeded();
        Locator picture = farm.card(CAMERA).locator("img");

        assertThat(picture).isVisible();
        farm.until(() -> ((Number) picture.evaluate("(image) => image.naturalWidth")).intValue() == 320);
        assertThat(farm.card(CAMERA)).containsText("Picture of");
    }

    @Test
    void sendsACommandAndReportsWhatBecameOfIt(FarmPage farm) {
        Locator card = farm.card(ROBOT);
        card.getByText("Stop", EXACTLY).click();

        assertThat(card.locator(".card-outcome")).containsText("✓ Stop");
        assertThat(card.locator(".card-facts")).containsText("Stopped");
        card.getByText("Resume", EXACTLY).click();
        assertThat(card.locator(".card-outcome")).containsText("✓ Resume");
        assertThat(card.locator(".card-facts")).containsText("Running");
    }

    /** Nobody keeps it: the context broker has no such entity. */
    @Tag("full")
    @Test
    void reportsWhyACommandWasNotSent(PageSuite suite) throws Exception {
        String lost = "urn:ngsi-ld:Robot:lost";
        suite.produce("data.raw", lost, robot(lost, "Running", Instant.now()));
        FarmPage farm = suite.open("").expectingError("status of 404.*commands");
        Locator card = farm.card(lost);
        card.getByText("Stop", EXACTLY).click();

        assertThat(card.locator(".card-outcome")).containsText("Stop was not sent:");
        suite.forget(lost);
    }

    @Tag("full")
    @Test
    void reportsThatADeviceIsSilent(PageSuite suite) throws Exception {
        String silent = "urn:ngsi-ld:Robot:silent";
        Instant before = Instant.now().minusSeconds(300);
        suite.produce("data.raw", silent, robot(silent, "Running", before), before);
        FarmPage farm = suite.open("");

        farm.find(".card-fold").click();
        assertThat(farm.card(silent)).hasClass(Pattern.compile("is-stale"));
        assertThat(farm.card(silent)).containsText("silent");
        suite.forget(silent);
    }

    @Tag("full")
    @Test
    void searchesFromTheKeyboard(FarmPage farm) {
        assertThat(farm.card(STATION)).isAttached();
        farm.find("body").press("/");
        farm.page().keyboard().type("robot 2");

        assertThat(farm.card("urn:ngsi-ld:Robot:2")).isVisible();
        assertThat(farm.find("furrow-cards li.card.device")).hasCount(1);
        farm.page().keyboard().press("Escape");
        assertThat(farm.card(STATION)).isAttached();
    }

    @Tag("full")
    @Test
    void showsOneKindOnly(FarmPage farm) {
        farm.find("furrow-cards .chip[data-key=camera]").click();

        assertThat(farm.find("furrow-cards li.card.device")).hasCount(2);
        assertThat(farm.card(CAMERA)).isVisible();
    }

    /** One time for all charts, and for the timeline. */
    @Tag("full")
    @Test
    void sharesTheCursorOfCharts(FarmPage farm) {
        farm.untilStore("(store.entities.get('" + DEFECTIVE + "')?.series.get('Temperature')?.length ?? 0) > 8"
                + " && (store.entities.get('urn:ngsi-ld:Robot:1')?.series.get('speed')?.length ?? 0) > 16");
        // Cards outside the window are not drawn: no other card comes between these two.
        farm.find("body").press("/");
        farm.page().keyboard().type("weeding");
        Locator chart = farm.card(DEFECTIVE).locator("svg.spark");
        int[] moves = {0};

        // An alarm that comes now moves the chart from under the pointer.
        farm.until(() -> {
            // A chart holds a number of points, not a period: at the right edge all charts have one.
            BoundingBox box = chart.boundingBox();
            if (box == null) { // the filter is just hiding or showing its card
                return false;
            }
            chart.hover(new Locator.HoverOptions().setPosition(box.width - 2 - moves[0]++ % 2, box.height / 2));
            return hasCursor(farm, DEFECTIVE)
                    && hasCursor(farm, "urn:ngsi-ld:Robot:1")
                    && farm.find("furrow-timeline .tl-cursor").isVisible();
        });
    }

    private static boolean hasCursor(FarmPage farm, String entity) {
        return "visible".equals(farm.card(entity).locator(".spark-rule").getAttribute("visibility"));
    }

    private static byte[] robot(String id, String state, Instant time) {
        return """
                {"id": "%s", "type": "ROBOT", "Domain": {"type": "String", "value": "farm"}, "Time": {"type": "Integer", "value": %d},
                 "Latitude": {"type": "Float", "value": 40.3125}, "Longitude": {"type": "Float", "value": -3.4822},
                 "state": {"type": "String", "value": "%s"}, "cmd": {"type": "String", "value": ""}}""".formatted(id, time.toEpochMilli(), state).getBytes(UTF_8);
    }
}
