package io.furrow.suite.page;

import java.util.List;
import java.util.regex.Pattern;

import com.microsoft.playwright.Locator;
import com.microsoft.playwright.options.BoundingBox;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static io.furrow.suite.page.FarmPage.having;

/** Results of analytics, and links from them to their moments. */
@PageTest
@Tag("full")
class AnalysesIT {
    @Test
    void showsAveragesAsAChartAndAsATableWithItsSuspects(PageSuite suite) {
        FarmPage farm = suite.open("#/analyses");
        assertThat(farm.find(".analysis.averages canvas").first()).isVisible();
        farm.find(".analysis.averages").getByText("Table").click();

        Locator rows = farm.find(".analysis.averages tbody tr");
        assertThat(rows.filter(having("Upper field"))
                        .filter(having("Thermometer 4"))
                        .first())
                .containsText("robust");
        assertThat(rows.filter(having("Mill field")).first()).containsText("unverified");
    }

    @Test
    void showsTheMomentOfAnEncounterOnTheMap(PageSuite suite) {
        FarmPage farm = suite.open("#/analyses").expectingError(ReplaysIT.NO_RESULTS_YET);
        farm.untilStore("store.recordings.has('weeding')");
        Locator row = farm.find(".analysis.encounters tbody tr")
                .filter(having("ended"))
                .first();
        assertThat(row).containsText(Pattern.compile("3\\.\\d m"));
        row.getByText("To the moment").click();

        assertThat(farm.find(".mode")).containsText("Replay of weeding");
        assertThat(farm.page()).hasURL(Pattern.compile("#/map"));
    }

    @Test
    void showsPresenceByField(PageSuite suite) {
        FarmPage farm = suite.open("#/analyses");
        farm.find(".analysis.presence").getByText("Table").click();

        assertThat(farm.find(".analysis.presence tbody tr")
                        .filter(having("Robot 1"))
                        .first())
                .containsText("Upper field");
    }

    @Test
    void beginsWithTheFirstResultAndFitsItsAxis(PageSuite suite) {
        FarmPage farm = suite.open("#/analyses");
        Locator averages = farm.find(".analysis.averages");
        assertThat(averages.locator("canvas").first()).isVisible();

        // a suite that has just started does not show an empty hour; the minimum is a minute
        farm.until(() -> Boolean.TRUE.equals(farm.run("""
                () => {
                  const { chart, findings } = document.querySelector('furrow-analyses');
                  const { min, max } = chart.plot.scales.x;
                  return Math.abs(min - Math.min(findings.first / 1000, max - 60)) < 1;
                }""")));
        BoundingBox panel = averages.boundingBox();
        BoundingBox chart = averages.locator(".uplot").boundingBox();
        Assertions.assertThat(panel.y + panel.height - chart.y - chart.height)
                .as("px below the chart")
                .isLessThan(20);
    }

    @Test
    void drawsStaysAtTheirPositionsOnTheAxis(FarmPage farm) {
        // the live axis grows to the right; in a replay an open stay grows on a fixed axis
        Object widths = farm.run("""
                async () => {
                  const { store } = await import('/core/store.js');
                  const { PresenceBars } = await import('/views/analyses/presence.js');
                  const bars = new PresenceBars(() => {});
                  const width = (to, end) => {
                    bars.show([{ id: 's', device: 'd', name: 'd', field: 'f', fieldName: 'f', from: 0, to }], [0, end]);
                    return parseFloat(bars.lines.querySelector('.gantt-bar').style.width);
                  };
                  const live = [width(60_000, 120_000), width(60_000, 240_000)];
                  const { mode } = store;
                  const replayed = [30_000, 60_000].map((position) => {
                    store.mode = { kind: 'replay', position };
                    return width(null, 120_000);
                  });
                  store.mode = mode;
                  bars.close();
                  return [...live, ...replayed].map(Math.round).join();
                }""");

        Assertions.assertThat(widths).isEqualTo("50,25,25,50");
    }

    @Test
    void fitsAPhone(PageSuite suite) {
        FarmPage farm = suite.open("#/analyses", WindowStyle.PHONE);
        Locator moment = farm.find(".analysis.encounters tbody tr").first().getByText("To the moment");
        assertThat(moment).isVisible();
        assertThat(farm.find(".gantt-name").first()).isVisible();

        moment.scrollIntoViewIfNeeded();
        BoundingBox button = moment.boundingBox();
        Assertions.assertThat(button.x).isPositive();
        Assertions.assertThat(button.x + button.width).isLessThan(WindowStyle.PHONE.width());
        for (String part : List.of(".encounter-frame", ".gantt-name", ".chart-legend")) {
            Assertions.assertThat(farm.find(part)
                            .evaluateAll("(all) => all.filter((each) => each.scrollWidth > each.clientWidth).length"))
                    .as(part + " truncated")
                    .isEqualTo(0);
        }
    }
}
