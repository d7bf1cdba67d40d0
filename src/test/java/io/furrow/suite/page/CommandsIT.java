package io.furrow.suite.page;

import java.time.Instant;

import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.EXACTLY;
import static org.awaitility.Awaitility.await;

/** Outcomes of commands to a robot that writes its entity itself, by its later reports. */
@PageTest
@Tag("full")
class CommandsIT {
    private static final String ROBOT = "urn:ngsi-ld:Robot:answers";
    private static final String MISSION = "/api/missions/answers";

    private FarmPage farm;
    private Locator outcome;

    @BeforeAll
    static void startMission(PageSuite suite) throws Exception {
        String mission = "{\"domain\":\"farm\",\"devices\":[\"" + ROBOT + "\"]}";
        await().until(() -> suite.rest("POST", MISSION + "/start", mission) == 200);
    }

    @AfterAll
    static void deleteMission(PageSuite suite) throws Exception {
        suite.rest("POST", MISSION + "/stop", "");
        await().until(() -> suite.rest("DELETE", MISSION, "") == 200);
    }

    /** The robot has answered an earlier command. */
    @BeforeEach
    void sendStop(PageSuite suite) throws Exception {
        report(suite, answer("OK", "Resume"));
        farm = suite.open("");
        farm.untilStore("store.devices.has('" + ROBOT + "')");
        outcome = farm.card(ROBOT).locator(".card-outcome");
        farm.card(ROBOT).getByText("Stop", EXACTLY).click();
        assertThat(outcome).containsText("no answer yet");
        farm.untilStore("store.entities.get('" + ROBOT + "').attributes.cmd.value === 'Stop'");
    }

    @AfterEach
    void deleteRobot(PageSuite suite) throws Exception {
        suite.running().ngsi().delete(ROBOT);
        suite.forget(ROBOT);
    }

    @Test
    void ignoresTheAnswerToAnEarlierCommand(PageSuite suite) throws Exception {
        long reportedAt = report(suite, "");

        farm.untilStore("store.entities.get('" + ROBOT + "').time >= " + reportedAt);
        outcome.evaluate("(element) => element.closest('li').card.draw()");
        assertThat(outcome).containsText("no answer yet");

        report(suite, answer("OK", "Stop"));
        assertThat(outcome).containsText("✓ Stop");
    }

    @Test
    void showsThatACommandFailedAndWhy(PageSuite suite) throws Exception {
        report(suite, answer("ERROR", "the brake is stuck"));

        assertThat(outcome).containsText("✗ Stop failed");
        assertThat(outcome).containsText("the brake is stuck");
    }

    /** Some agents do not update the status and put the answer into the info. */
    @Test
    void acceptsTheInfoAsAnswerWhileTheStatusIsPending(PageSuite suite) throws Exception {
        report(suite, answer("PENDING", ""));
        assertThat(outcome).containsText("no answer yet");

        report(suite, answer("PENDING", "stopped at row 7"));
        assertThat(outcome).containsText("✓ Stop");
    }

    @Test
    void showsThatNoAnswerCame(PageSuite suite) throws Exception {
        report(suite, answer("PENDING", ""));
        outcome.evaluate("(element) => { element.closest('li').card.sent.at -= 31_000; }");

        assertThat(outcome).containsText("Stop: no answer since");
    }

    private static String answer(String status, String info) {
        return """
                , "cmd": {"type": "String", "value": ""}, "cmd_status": {"type": "commandStatus", "value": "%s"},
                "cmd_info": {"type": "commandResult", "value": "%s"}""".formatted(status, info);
    }

    /** @return the time of the report */
    private static long report(PageSuite suite, String answer) throws Exception {
        long now = Instant.now().toEpochMilli();
        String entity = """
                {"id": "%s", "type": "ROBOT", "Domain": {"type": "String", "value": "farm"}, "Time": {"type": "Integer", "value": %d},
                 "Latitude": {"type": "Float", "value": 40.3125}, "Longitude": {"type": "Float", "value": -3.4822},
                 "state": {"type": "String", "value": "Running"}%s}""".formatted(ROBOT, now, answer);
        suite.running().ngsi().append(entity);
        return now;
    }
}
