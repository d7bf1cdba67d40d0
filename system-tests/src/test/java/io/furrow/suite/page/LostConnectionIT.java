package io.furrow.suite.page;

import java.util.regex.Pattern;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.Dashboard;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** The dashboard is gone, and comes back. */
@PageTest
@Tag("full")
class LostConnectionIT {
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
}
