package io.furrow.suite.page;

import java.nio.charset.StandardCharsets;
import java.time.Instant;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** What a card says of a command that was taken, by what the device then reports. */
@PageTest
@Tag("full")
class CommandsIT {
    private static final String ROBOT = "urn:ngsi-ld:Robot:answers";

    private Locator outcome;

    @BeforeEach
    void stopARobot(PageSuite suite) throws Exception {
        report(suite, "", "");
        FarmPage farm = suite.open("");
        farm.page()
                .route("**/api/devices/*/commands", route -> route.fulfill(new Route.FulfillOptions().setStatus(202)));
        outcome = farm.card(ROBOT).locator(".card-outcome");
        farm.card(ROBOT)
                .getByText("Stop", new Locator.GetByTextOptions().setExact(true))
                .click();
        assertThat(outcome).containsText("no answer yet");
    }

    @AfterEach
    void forgetIt(PageSuite suite) throws Exception {
        suite.forget(ROBOT);
    }

    @Test
    void saysThatACommandFailedAndWhy(PageSuite suite) throws Exception {
        report(suite, "ERROR", "the brake is stuck");

        assertThat(outcome).containsText("✗ Stop failed");
        assertThat(outcome).containsText("the brake is stuck");
    }

    /** As some agents leave it: the status stays, and the answer is in the info. */
    @Test
    void takesTheInfoForTheAnswerWhileTheStatusIsPending(PageSuite suite) throws Exception {
        report(suite, "PENDING", "");
        assertThat(outcome).containsText("no answer yet");

        report(suite, "PENDING", "stopped at row 7");
        assertThat(outcome).containsText("✓ Stop");
    }

    @Test
    void saysThatNoAnswerCame(PageSuite suite) throws Exception {
        report(suite, "PENDING", "");
        outcome.evaluate("(element) => { element.closest('li').card.sent.at -= 31_000; }");

        assertThat(outcome).containsText("Stop: no answer since");
    }

    private static void report(PageSuite suite, String status, String info) throws Exception {
        String entity = """
                {"id": "%s", "type": "ROBOT", "Domain": {"type": "String", "value": "farm"}, "Time": {"type": "Integer", "value": %d},
                 "Latitude": {"type": "Float", "value": 40.3125}, "Longitude": {"type": "Float", "value": -3.4822}, "state": {"type": "String", "value": "Running"},
                 "cmd": {"type": "String", "value": ""}, "cmd_status": {"type": "commandStatus", "value": "%s"}, "cmd_info": {"type": "commandResult", "value": "%s"}}""".formatted(ROBOT, Instant.now().toEpochMilli(), status, info);
        suite.produce("data.raw", ROBOT, entity.getBytes(StandardCharsets.UTF_8));
    }
}
