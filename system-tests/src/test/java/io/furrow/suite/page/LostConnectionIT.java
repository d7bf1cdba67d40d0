package io.furrow.suite.page;

import java.util.regex.Pattern;

import com.microsoft.playwright.Route;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.Dashboard;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** The dashboard is gone, and comes back. */
@PageTest
@Tag("full")
class LostConnectionIT {
    private static final String COLLISIONS = "store.topics.get('data.collision')";

    @Test
    void keepsWhatItShowedSaysSoAndGoesOn(PageSuite suite) throws Exception {
        Dashboard dashboard = suite.ownDashboard(0);
        int port = dashboard.uri().getPort();
        FarmPage farm = suite.open(dashboard.uri(), "", Look.DESK)
                .expectingError("ERR_CONNECTION|WebSocket connection|Failed to load resource|Failed to fetch");
        farm.untilStore("store.entities.size >= 17");

        dashboard.close();
        assertThat(farm.find(".notice")).containsText("trying again. What is shown is from");
        assertThat(farm.card("urn:ngsi-ld:Robot:1")).isVisible();

        try (Dashboard again = suite.ownDashboard(port)) {
            org.assertj.core.api.Assertions.assertThat(again.uri()).hasPort(port);
            assertThat(farm.find(".notice"))
                    .hasText(Pattern.compile("^The connection was away from [\\d:]{8} to [\\d:]{8}\\."));
            assertThat(farm.find(".notice")).isHidden();
            farm.untilStore("store.entities.get('urn:ngsi-ld:Robot:1').time > " + System.currentTimeMillis());
            farm.close();
        }
    }

    /** The server goes on counting, as another page reads the topic all the time. */
    @Test
    void countsWhatItMissed(PageSuite suite) {
        FarmPage other = suite.open("");
        FarmPage farm = suite.window(suite.running().suite().dashboard(), Look.DESK)
                .expectingError("ERR_FAILED|Failed to load resource");
        farm.page().addInitScript("""
                window.sockets = [];
                window.WebSocket = class extends WebSocket {
                  constructor(...address) {
                    super(...address);
                    window.sockets.push(this);
                  }
                };""");
        farm.open("");
        farm.untilStore(COLLISIONS + ".count > 0");

        farm.page().route("**/api/register/**", Route::abort);
        farm.page().evaluate("sockets.forEach((socket) => socket.close())");
        assertThat(farm.find(".notice")).containsText("trying again");
        int known = (int) other.store(COLLISIONS + ".count");
        other.untilStore(COLLISIONS + ".count > " + (known + 2));
        farm.page().unroute("**/api/register/**");

        farm.untilStore(COLLISIONS + ".gap > 2");
    }
}
