package io.furrow.suite.page;

import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.assertions.LocatorAssertions;
import com.microsoft.playwright.options.AriaRole;
import com.microsoft.playwright.options.BoundingBox;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.having;

/** The map: fields, devices, encounters, labels and controls. */
@PageTest
class MapIT {
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:1";
    private static final int CRITICAL = 0xFF7A6B;
    private static final int BORDER_OF_FIELDS = 0x4C7A58;
    private static final int BORDER_OF_ZONES = 0x9FB2A6;
    private static final int WARNING = 0xFFC14D;

    @Test
    void drawsTheFieldsAndEveryDevice(FarmPage farm) {
        farm.untilStore("store.fields.size === 4 && store.entities.size >= 17"
                + " && ['field-1', 'field-2', 'field-3'].every((id) => store.averages.has(id))"
                + " && store.entities.get('" + ROBOT + "').trail.length > 5");
        farm.until(() -> farm.mapPixels(BORDER_OF_FIELDS) > 300);
        assertThat(farm.find("furrow-map .empty")).isHidden();
    }

    /** Red occurs on the map only while two devices are close to each other. */
    @Tag("full")
    @Test
    void drawsAnEncounterWhileItIsOngoing(FarmPage farm) {
        String ongoing = "[...store.encounters.values()].some((each) => ['started', 'ongoing'].includes(each.phase))";

        farm.untilStore("store.encounters.size > 0");
        farm.until(() -> Boolean.TRUE.equals(farm.store(ongoing)) && farm.mapPixels(CRITICAL) > 200, FarmPage.TIMEOUT);
        farm.until(() -> Boolean.FALSE.equals(farm.store(ongoing)) && farm.mapPixels(CRITICAL) == 0, FarmPage.TIMEOUT);
    }

    @Test
    void selectsTheCardOfAClickedDevice(FarmPage farm) {
        farm.untilStore("store.entities.has('" + THERMOMETER + "') && store.primed && store.fields.size > 0");
        assertThat(farm.card(THERMOMETER)).not().hasClass(Pattern.compile("selected"));

        double[] spot = farm.ownSpot(THERMOMETER);
        farm.page().mouse().click(spot[0], spot[1]);

        assertThat(farm.card(THERMOMETER)).hasClass(Pattern.compile("selected"));
        assertThat(farm.card(THERMOMETER)).isInViewport();
    }

    @Tag("full")
    @Test
    void centersTheDeviceOfAClickedCard(FarmPage farm) {
        farm.card(THERMOMETER).getByRole(AriaRole.BUTTON).first().click();

        farm.untilStore("store.selection === '" + THERMOMETER + "'");
        BoundingBox map = farm.find("furrow-map .map-target").boundingBox();
        farm.until(() -> {
            double[] spot = farm.spot(THERMOMETER);
            return Math.hypot(spot[0] - map.x - map.width / 2, spot[1] - map.y - map.height / 2) < 5;
        });
    }

    @Tag("full")
    @Test
    void showsTheContentOfTheMapAsTables(FarmPage farm) {
        farm.button("The map as a table").click();
        Locator rows = farm.find(".map-table table[aria-label=Devices] tbody tr");

        assertThat(rows).hasCount(((Number) farm.store("store.entities.size")).intValue());
        Locator robot = rows.filter(having("Robot 1"));
        assertThat(robot).containsText("robot");
        assertThat(robot).containsText("1.50 m/s");
        robot.getByRole(AriaRole.BUTTON).click();
        assertThat(farm.card(ROBOT)).hasClass(Pattern.compile("selected"));

        Locator upper =
                farm.find(".map-table table[aria-label=Fields] tbody tr").filter(having("Upper field"));
        assertThat(upper).containsText("°C");
        assertThat(upper).containsText("Thermometer 4");
        Locator close =
                farm.find(".map-table table[aria-label=Encounters] tbody tr").filter(having("Robot 1 – Robot 2"));
        assertThat(close).containsText("too close", new LocatorAssertions.ContainsTextOptions().setTimeout(60_000));
    }

    @Tag("full")
    @Test
    void clustersManyRobotsAndListsThoseThatNoZoomDistinguishes(FarmPage farm) {
        farm.untilStore("store.primed && store.entities.size >= 17");
        report(farm, 200, 40.312998, -3.483058);
        farm.run("document.querySelector('furrow-map').fit(0)");
        farm.until(() -> (int)
                        farm.number(
                                "Math.max(0, ...document.querySelector('furrow-map').devices.clusters.map((each) => each.count))")
                == 200); // more while the view is still moving
        Locator list = farm.find(".map-list");
        farm.until(() -> {
            double[] spot = farm.spot("urn:ngsi-ld:Tractor:7"); // moves while the view does
            farm.page().mouse().click(spot[0], spot[1]);
            return list.isVisible();
        });

        assertThat(list.getByText("200 devices in one spot")).isVisible();
        farm.page().keyboard().press("Tab");
        farm.page().keyboard().press("Enter");
        assertThat(list).isHidden();
        farm.untilStore("store.selection?.startsWith('urn:ngsi-ld:Tractor:')");
    }

    @Tag("full")
    @Test
    void fitsTheFarmThoughOneDeviceIsFarAway(FarmPage farm) {
        farm.untilStore("store.primed && store.entities.size >= 17");
        farm.run(
                "async () => { const { store } = await import('/core/store.js'); store.fields.clear(); store.notify('fields'); }");
        report(farm, 1, -33.9, 18.4);
        farm.run("document.querySelector('furrow-map').fit(0)");

        farm.until(() -> zoom(farm) > 14);
        double[] robot = farm.spot(ROBOT);
        BoundingBox map = farm.find("furrow-map .map-target").boundingBox();
        Assertions.assertThat(robot[0]).isBetween(map.x, map.x + map.width);
        Assertions.assertThat(robot[1]).isBetween(map.y, map.y + map.height);
    }

    @Tag("full")
    @Test
    void drawsNothingBehindAnotherView(FarmPage farm) {
        farm.untilStore("store.primed && store.entities.size >= 17");
        farm.run(
                "() => { window.drawn = 0; document.querySelector('furrow-map').map.on('postrender', () => window.drawn++); }");
        farm.until(() -> drawn(farm) > 5);

        farm.go("Platform");
        assertThat(farm.find("furrow-platform h1")).isVisible();
        int before = drawn(farm);
        double time = System.currentTimeMillis();
        farm.untilStore("store.entities.get('" + ROBOT + "').time > " + (time + 1_500));
        Assertions.assertThat(drawn(farm)).isEqualTo(before);
        farm.go("Map");
        farm.until(() -> drawn(farm) > before);
    }

    @Tag("full")
    @Test
    void drawsAPredictedEncounterUntilItStarts(FarmPage farm) {
        farm.untilStore("store.primed && store.fields.size === 4");
        report(farm, 2, 40.3125, -3.4822);
        farm.until(() -> farm.mapPixels(WARNING) > 200, FarmPage.TIMEOUT); // the suspect thermometer
        int before = farm.mapPixels(WARNING);

        collision(farm, "predicted");
        farm.until(() -> farm.mapPixels(WARNING) > before + 300);
        farm.button("The map as a table").click();
        assertThat(farm.find(".map-table table[aria-label=Encounters] tbody"))
                .containsText("Tractor 0 – Tractor 1predicted");

        int with = farm.mapPixels(WARNING);
        collision(farm, "started");
        farm.until(() -> farm.mapPixels(WARNING) < with - 300);
    }

    private static void collision(FarmPage farm, String phase) {
        farm.run("""
                        async (phase) => {
                          const { store } = await import('/core/store.js');
                          const all = { Device1_ID: 'urn:ngsi-ld:Tractor:0', Device2_ID: 'urn:ngsi-ld:Tractor:1', phase, distance: 9, dcpa: 1.2, tcpa: 40,
                            Device1_latitude: 40.3125, Device1_longitude: -3.4822, Device2_latitude: 40.3125, Device2_longitude: -3.4822 };
                          const value = { type: 'Analytics:Collision' };
                          Object.entries(all).forEach(([name, each]) => (value[name] = { value: each }));
                          store.applyEncounter({ time: Date.now(), value });
                        }""", phase);
    }

    @Tag("full")
    @Test
    void drawsAZoneWithoutAlarms(FarmPage farm) {
        farm.untilStore("store.primed && store.fields.size === 4");
        farm.button("The map as a table").click();
        String zone = "[...store.fields.values()].find((each) => each.exclusion)";
        Locator row = farm.find(".map-table table[aria-label=Fields] tbody tr")
                .filter(new Locator.FilterOptions().setHasText((String) farm.store(zone + ".name")));
        assertThat(row).containsText("no alarms");

        int with = farm.mapPixels(BORDER_OF_ZONES);
        farm.store("void (store.fields.delete(" + zone + ".id), store.notify('fields'))");
        farm.until(() -> farm.mapPixels(BORDER_OF_ZONES) < with - 20);
    }

    /** The suspects of a field may arrive before the field, since they come from different topics. */
    @Tag("full")
    @Test
    void marksASuspectThoughItsFieldArrivesLater(FarmPage farm) {
        farm.untilStore("store.primed && store.fields.size === 4");
        report(farm, 1, 40.3125, -3.4822);
        farm.run("""
                async () => {
                  const { store } = await import('/core/store.js');
                  const all = { field: 'later', averageTemperature: 12.5, devices: 4, suspects: ['urn:ngsi-ld:Tractor:0'], quality: 'robust' };
                  const value = { type: 'Analytics:FieldTemperature' };
                  Object.entries(all).forEach(([name, each]) => (value[name] = { value: each }));
                  store.applyTemperature({ time: Date.now(), value });
                  store.applyField({ key: 'later@2026-01-01T00:00:00.000Z', value: { properties: { name: 'Later field' },
                    geometry: { type: 'Polygon', coordinates: [[[-3.49, 40.31], [-3.48, 40.31], [-3.48, 40.32], [-3.49, 40.31]]] } } });
                }""");

        farm.untilStore("store.entities.get('urn:ngsi-ld:Tractor:0').state === 'attention'");
        assertThat(farm.card("urn:ngsi-ld:Tractor:0")).containsText("suspect");
        farm.button("The map as a table").click();
        assertThat(farm.find(".map-table table[aria-label=Fields] tbody tr").filter(having("Later field")))
                .containsText("12.5 °C");
    }

    private static int drawn(FarmPage farm) {
        return (int) farm.number("window.drawn");
    }

    /** Applies reports in this window only. */
    private static void report(FarmPage farm, int count, double latitude, double longitude) {
        farm.run("""
                        async ([count, latitude, longitude]) => {
                          const { store } = await import('/core/store.js');
                          for (let number = 0; number < count; number++) {
                            const id = `urn:ngsi-ld:Tractor:${number}`;
                            store.applyEntity({ key: id, kind: 'event', time: Date.now(), headers: {},
                              value: { id, type: 'Tractor', Latitude: { value: latitude }, Longitude: { value: longitude } } });
                          }
                        }""", java.util.List.of(count, latitude, longitude));
    }

    @Tag("full")
    @Test
    void movesToTheSearchedField(FarmPage farm) {
        farm.untilStore("store.fields.size === 4 && store.primed");
        double whole = zoom(farm);

        farm.page().getByRole(AriaRole.SEARCHBOX).fill("river field");
        farm.page().getByRole(AriaRole.SEARCHBOX).press("Enter");

        farm.until(() -> zoom(farm) > whole + 0.2);
        assertThat(farm.find("furrow-cards .empty")).containsText("No device matches");
    }

    @Tag("full")
    @Test
    void isMovedAndZoomedByTheKeyboard(FarmPage farm) {
        farm.untilStore("store.entities.has('" + THERMOMETER + "') && store.primed");
        Locator map =
                farm.page().getByRole(AriaRole.APPLICATION, new Page.GetByRoleOptions().setName("Map of the farm"));
        map.focus();
        double[] before = farm.spot(THERMOMETER);

        farm.page().keyboard().press("ArrowRight");
        farm.until(() -> farm.spot(THERMOMETER)[0] < before[0] - 20);
        double zoom = zoom(farm);
        farm.page().keyboard().press("+");
        farm.until(() -> zoom(farm) > zoom + 0.4);
    }

    private static double zoom(FarmPage farm) {
        return farm.number("document.querySelector('furrow-map').view.getZoom()");
    }

    /** The map of a phone has room for text inside the outline of some fields only. */
    @Tag("full")
    @Test
    void showsTheAverageOfEachFieldWithoutCoveringSymbols(PageSuite suite) {
        FarmPage farm = suite.open("", WindowStyle.PHONE);
        farm.untilStore("store.primed && store.entities.size >= 17"
                + " && ['field-1', 'field-2', 'field-3'].every((id) => store.averages.has(id))");
        farm.until(() -> labels(farm, "each.line.includes('°C') && isFree") == 3);

        // a robot drives onto each label
        farm.run("""
                        async () => {
                          const { store } = await import('/core/store.js');
                          const { map, devices } = document.querySelector('furrow-map');
                          devices.fieldLabels.drawn.filter(({ line }) => line.includes('°C')).forEach(({ box: [left, top] }, number) => {
                            const [longitude, latitude] = ol.proj.toLonLat(map.getCoordinateFromPixel([left + 20, top + 9]));
                            const id = `urn:ngsi-ld:Robot:on-${number}`;
                            store.applyEntity({ key: id, kind: 'event', time: Date.now(), headers: {},
                              value: { id, type: 'Robot', Latitude: { value: latitude }, Longitude: { value: longitude } } });
                          });
                        }""");
        farm.until(() -> (int)
                        farm.number(
                                "document.querySelector('furrow-map').devices.spots.filter(({ entity }) => entity.id.includes(':on-')).length")
                >= 3);
        farm.until(() -> labels(farm, "isFree") >= 3 && labels(farm, "!isFree") == 0);
    }

    /** The number of labels of fields for which an expression over {@code each} and {@code isFree} is true. */
    private static int labels(FarmPage farm, String expression) {
        return ((Number) farm.run("""
                        () => {
                          const { spots, fieldLabels } = document.querySelector('furrow-map').devices;
                          return fieldLabels.drawn.filter((each) => {
                            const [left, top, right, bottom] = each.box;
                            const isFree = spots.every(({ x, y }) => x < left || x > right || y < top || y > bottom);
                            return %s;
                          }).length;
                        }""".formatted(expression))).intValue();
    }
}
