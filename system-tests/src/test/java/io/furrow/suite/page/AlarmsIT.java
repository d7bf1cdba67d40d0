package io.furrow.suite.page;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Locator;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** From an alarm to who takes care of it. */
@PageTest
@Tag("full")
class AlarmsIT {
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
        org.assertj.core.api.Assertions.assertThat(acknowledged).isTrue();
    }

    /** Two robots meet each half minute. */
    @Test
    void tellsANewAlarmToScreenReadersAndCountsIt(PageSuite suite) {
        FarmPage farm = suite.open("");

        assertThat(farm.find("furrow-alarms [aria-live=assertive]")).containsText("New alarm, critical: Robot 1");
        assertThat(farm.find(".alarm-count"))
                .hasAttribute("aria-label", java.util.regex.Pattern.compile("[1-9]\\d* open alarms"));
    }

    private static Locator.FilterOptions suspect() {
        return new Locator.FilterOptions().setHasText("Thermometer 4");
    }
}
