package io.furrow.suite.page;

import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.util.List;
import java.util.Properties;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.options.AriaRole;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.dashboard.Dashboard;
import io.furrow.dashboard.DashboardSettings;
import io.furrow.embedded.FreePort;
import io.furrow.kafka.Readiness;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A user with the role viewer, and a control plane with tokens that starts after the dashboard. */
@PageTest
@Tag("full")
class ViewerIT {
    private static final String TOKEN = "vera-looks-at-the-farm-0001";
    private static final String COMMANDS =
            "^(Stop all robots|(Stop|Resume|On|Off|Restart)(: .*)?|Start|Delete.*|New .*|Create|Import.*|Acknowledge.*|Mute.*|Close|Replay|Replay .*|Play|Play again|Pause|Step .*|Loop|Add .*|Choose .*|To the moment.*|Start .*)$";
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";

    @Test
    void waitsForTheControlPlaneSignsInAndOffersNoCommand(PageSuite suite, @TempDir Path folder) throws Exception {
        Properties client = suite.running().suite().kafka().clientProperties();
        int port = FreePort.orFree(0);
        RestSettings settings = RestSettings.on(port)
                .withTokens(Files.writeString(folder.resolve("tokens"), "vera %s viewer%n".formatted(TOKEN)));
        try (Dashboard dashboard =
                Dashboard.start(DashboardSettings.of(0, client, URI.create("http://127.0.0.1:" + port)))) {
            FarmPage farm = suite.window(dashboard.uri(), WindowStyle.DESKTOP)
                    .expectingError("status of (401|403|501|502|503)|status of 404.*images");
            farm.page().navigate(dashboard.uri().resolve("/").toString());
            assertThat(farm.page().getByRole(AriaRole.ALERT)).containsText("The farm cannot be shown yet");

            try (RestApi api = RestApi.start(ControlSettings.of(client), settings, new Readiness(Clock.systemUTC()))) {
                await().until(api::isReady);
                signIn(farm);
                viewFarm(farm);
                sendCommand(farm);
                farm.button("Settings").click();
                farm.button("Sign out").click();
                assertThat(farm.page().getByLabel("Access token")).isVisible();
                farm.close();
            }
        }
    }

    private static void signIn(FarmPage farm) {
        farm.page().getByLabel("Access token").fill("somebody-elses-token-000001");
        farm.button("Sign in").click();
        assertThat(farm.page().getByRole(AriaRole.ALERT)).hasText("The control plane does not know this token.");

        farm.page().getByLabel("Access token").fill(TOKEN);
        farm.button("Sign in").click();
    }

    private static void viewFarm(FarmPage farm) {
        Locator card = farm.card(ROBOT);
        assertThat(card).containsText("m/s");
        assertNoCommands(farm, "map");
        farm.go("Missions");
        assertThat(farm.page().getByText("Commands require the role of an operator"))
                .isVisible();
        assertThat(farm.find(".mission-detail")).containsText("Heard");
        assertNoCommands(farm, "missions");
        farm.page()
                .getByRole(AriaRole.TAB, new Page.GetByRoleOptions().setName("Domains and fields"))
                .click();
        assertThat(farm.find(".domain-columns")).containsText("River field");
        assertNoCommands(farm, "domains");
        farm.go("Replays");
        assertThat(farm.find("furrow-replays")).containsText("Viewers can watch running replays");
        assertNoCommands(farm, "replays");
        farm.go("Analyses");
        assertThat(farm.find(".gantt-bar").first()).isVisible();
        assertNoCommands(farm, "analyses");
        farm.go("Map");
    }

    /** Asserts that no command is offered, not even as a disabled button. */
    private static void assertNoCommands(FarmPage farm, String place) {
        Object offered = farm.run("""
                (forbidden) => [...document.querySelectorAll('button, a.button, input[type=checkbox]')]
                  .filter((each) => each.checkVisibility({ visibilityProperty: true }))
                  .map((each) => each.getAttribute('aria-label') ?? (each.textContent || each.id))
                  .filter((each) => new RegExp(forbidden).test(each))""", COMMANDS);
        Assertions.assertThat((List<?>) offered).as(place).isEmpty();
    }

    /** A command that is sent without a button is rejected too. */
    private static void sendCommand(FarmPage farm) {
        Object response = farm.run("""
                        async ([token, robot]) => {
                          const answer = await fetch(`/api/devices/${robot}/commands`, {
                            method: 'POST', headers: { Authorization: `Bearer ${token}`, 'Content-Type': 'application/json' },
                            body: JSON.stringify({ command: 'Stop' }),
                          });
                          return `${answer.status} ${await answer.text()}`;
                        }""", List.of(TOKEN, ROBOT));
        Assertions.assertThat(response).asString().startsWith("403 ").contains("operator");
    }
}
