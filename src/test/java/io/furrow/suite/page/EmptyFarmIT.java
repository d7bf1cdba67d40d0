package io.furrow.suite.page;

import java.net.URI;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.options.AriaRole;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.having;

/** The page of an empty farm, and the page before the state of the farm is known. */
@PageTest
@Tag("full")
class EmptyFarmIT {
    @Test
    void showsInEachViewThatItIsEmptyAndHowToFillIt(PageSuite suite) {
        FarmPage farm = suite.window();
        farm.page().routeWebSocket("**/socket/**", socket -> socket.send("{\"primed\":true}"));
        farm.page().route("**/api/**", EmptyFarmIT::answerEmpty);
        farm.open("");

        assertThat(farm.find("furrow-map .map-empty")).containsText("No devices yet");
        assertThat(farm.find("furrow-map .map-empty code")).hasText("./furrow demo");
        assertThat(farm.find("furrow-cards .empty")).containsText("No devices yet");
        assertThat(farm.find("furrow-cards .skeleton").first()).isHidden();
        assertThat(farm.find(".alarm-none")).hasText("No open alarms");

        farm.go("Missions");
        assertThat(farm.find("furrow-missions .empty")).containsText("No missions yet");
        assertThat(farm.find("furrow-missions .empty").getByRole(AriaRole.BUTTON))
                .hasText("New mission");
        tab(farm, "Domains and fields");
        assertThat(farm.find("furrow-missions")).containsText("No domains yet");
        assertThat(farm.find("furrow-missions")).containsText("No fields yet");
        tab(farm, "Who commanded what");
        assertThat(farm.find("furrow-missions")).containsText("Nobody has commanded anything yet.");

        farm.go("Replays");
        assertThat(farm.find("furrow-replays")).containsText("No missions are stored yet");
        assertThat(farm.find("furrow-replays")).containsText("No replay runs");
        farm.go("Analyses");
        for (String empty : new String[] {"No averages", "No encounters", "No device was in a field"}) {
            assertThat(farm.find("furrow-analyses")).containsText(empty + " in this period");
        }
        farm.go("Topics");
        assertThat(farm.find("furrow-topics")).containsText("There is no domain yet");
        assertThat(farm.find("furrow-topics")).containsText("No topic chosen");
    }

    @Test
    void showsSkeletonsWhileLoading(PageSuite suite) {
        FarmPage farm = suite.window();
        farm.page().routeWebSocket("**/socket/**", socket -> {});
        farm.page().route("**/api/**", route -> {
            if (path(route).startsWith("/api/me") || path(route).startsWith("/api/register")) {
                route.resume();
            } // the others are not answered
        });
        farm.open("");

        assertThat(farm.find("furrow-cards .skeleton").first()).isVisible();
        assertThat(farm.find(".alarm-none")).hasText("Alarms are being read …");
        assertThat(farm.find("furrow-map .map-empty")).isHidden();
        assertThat(farm.find("furrow-cards .empty")).isHidden();
        for (String view : new String[] {"Missions", "Replays", "Analyses"}) {
            farm.go(view);
            Locator skeleton = farm.find("furrow-" + view.toLowerCase(java.util.Locale.ROOT) + " .skeleton");
            assertThat(skeleton.first()).isVisible();
            assertThat(farm.find(".view-place .empty:visible").filter(having("yet")))
                    .hasCount(0);
        }
    }

    private static void tab(FarmPage farm, String name) {
        farm.page()
                .getByRole(AriaRole.TAB, new Page.GetByRoleOptions().setName(name))
                .click();
    }

    static void answerEmpty(Route route) {
        String path = path(route);
        if (path.equals("/api/me") || path.startsWith("/api/register")) {
            route.resume();
            return;
        }
        String empty = path.startsWith("/api/history")
                ? "{\"since\":0,\"records\":[]}"
                : path.startsWith("/api/density") ? "{\"from\":0,\"width\":5000,\"counts\":[]}" : "[]";
        route.fulfill(
                new Route.FulfillOptions().setContentType("application/json").setBody(empty));
    }

    private static String path(Route route) {
        return URI.create(route.request().url()).getPath();
    }
}
