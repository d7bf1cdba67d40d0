package io.furrow.suite.page;

import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.Route;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.having;

/** Topics of domains and missions, and their records. */
@PageTest
class TopicsIT {
    @Test
    void showsDomainsWithTheirMissionsAndRates(PageSuite suite) {
        FarmPage farm = suite.open("#/topics");

        for (String topic : """
                data.collision data.farm.realtime data.farm.realtime.weeding data.farm.realtime.scouting
                data.canary.realtime.dummy""".split("\\s+")) {
            assertThat(row(farm, topic)).isVisible();
        }
        assertThat(row(farm, "data.farm.realtime.weeding").locator(".topic-rate"))
                .hasText(Pattern.compile("^([2-9]|1\\d)(\\.\\d)?/s$"));
    }

    @Tag("full")
    @Test
    void listsCollisionsAndTheCanaryBeforeTheyExist(PageSuite suite) {
        FarmPage farm = suite.window();
        farm.page()
                .route(
                        "**/api/topics",
                        route -> route.fulfill(new Route.FulfillOptions()
                                .setContentType("application/json")
                                .setBody("[]")));
        farm.open("#/topics");

        assertThat(row(farm, "data.collision")).containsText("no records yet");
        assertThat(row(farm, "canary")).containsText("no records yet");
    }

    @Tag("full")
    @Test
    void showsTheRecordsOfSeveralTopicsAtOnce(PageSuite suite) {
        FarmPage farm = suite.open("#/topics");
        check(farm, "data.farm.realtime.weeding");
        check(farm, "data.canary.realtime.dummy");
        Locator records = farm.find("furrow-topics table tbody tr");

        assertThat(records.filter(having("Robot canary-1")).first()).isVisible();
        assertThat(records.filter(having("Thermometer 4")).first()).isVisible();
    }

    @Tag("full")
    @Test
    void showsOnlyAMissionOnTheMap(PageSuite suite) {
        FarmPage farm = suite.open("#/topics");
        farm.button("Show only scouting on the map").click();

        assertThat(farm.page()).hasURL(Pattern.compile("#/map"));
        assertThat(farm.card("urn:ngsi-ld:Camera:1")).isAttached();
        assertThat(farm.card("urn:ngsi-ld:Robot:1")).hasCount(0);
        assertThat(farm.find(".crumbs")).containsText("scouting");
    }

    @Tag("full")
    @Test
    void showsTheScopeOnASmallScreen(PageSuite suite) {
        FarmPage farm = suite.open("#/topics", WindowStyle.PHONE);
        assertThat(farm.find(".crumbs")).isHidden();
        farm.button("Show only scouting on the map").click();

        assertThat(farm.find(".crumbs")).containsText("scouting");
        farm.button("Show everything on the map again").click();
        assertThat(farm.find(".crumbs")).isHidden();
        farm.untilStore("store.scope.domain === null");
    }

    private static Locator row(FarmPage farm, String topic) {
        return farm.page()
                .locator(".topic-row", new Page.LocatorOptions().setHas(farm.find("[id='topic-" + topic + "']")));
    }

    private static void check(FarmPage farm, String topic) {
        farm.find("[id='topic-" + topic + "']").check();
    }
}
