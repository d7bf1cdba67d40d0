package io.furrow.suite.page;

import com.microsoft.playwright.Page;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** The timeline of recent records below the map. */
@PageTest
@Tag("full")
class TimelineIT {
    private static final Page.WaitForConditionOptions SOON = new Page.WaitForConditionOptions().setTimeout(10_000);

    /**
     * The number of buckets whose count in the page differs from Kafka's, among those that ended two seconds ago; -1
     * while nothing is shown.
     */
    private static final String WRONG_BUCKETS = """
            async () => {
              const { live } = document.querySelector('furrow-timeline');
              if (!live) {
                return -1; // the page is not complete yet
              }
              const shown = [...live.counts].filter(([, count]) => count > 0);
              const [from, to] = [Math.min(...shown.map(([start]) => start)), Math.floor((Date.now() - 2000) / live.width) * live.width];
              if (!shown.length || to <= from) {
                return -1;
              }
              const before = new Map(live.counts);
              const answer = await fetch(`/api/density/data.raw?from=${from}&to=${to}&width=${live.width}`);
              const { counts } = await answer.json();
              return counts.filter((count, index) => (before.get(from + index * live.width) ?? 0) !== count).length;
            }""";

    @Test
    void showsRecordsFromBeforeThePageWasOpenedWithoutAGap(PageSuite suite) {
        FarmPage before = suite.open("");
        // more than half a minute, the time for which the newest events of a mission are not stored yet
        before.untilStore("store.entities.get('urn:ngsi-ld:Robot:1')?.trail.length > 45");
        before.untilStore("store.encounters.size > 0");
        before.close();

        FarmPage farm = suite.open("");
        farm.until(() -> farm.number(WRONG_BUCKETS) == 0, SOON);
        assertThat(
                        farm.number(
                                "() => [...document.querySelector('furrow-timeline').live.counts.values()].filter((count) => count > 0).length"))
                .isGreaterThan(6);
        farm.until(() -> farm.number("document.querySelector('furrow-timeline').encounters.length") > 0, SOON);
    }

    @Test
    void continuesWithNewRecordsAndCountsNoneTwice(FarmPage farm) {
        farm.until(() -> farm.number(WRONG_BUCKETS) == 0, SOON);

        double opened = System.currentTimeMillis();
        farm.untilStore("Math.min(...['1', '2'].map((id) => store.entities.get(`urn:ngsi-ld:Robot:${id}`)?.time)) > "
                + (opened + 20_000));
        farm.until(() -> farm.number(WRONG_BUCKETS) == 0, SOON);
    }

    /** Also in the first minute: the timeline is as long as there are records. */
    @Test
    void beginsWithTheFirstRecord(FarmPage farm) {
        Object length = farm.run("""
                async () => {
                  const { LiveDensity } = await import('/timeline/live.js');
                  const density = new LiveDensity(() => {});
                  density.countedTo = Date.now();
                  density.counts.set(Date.now() - 30_000, 7);
                  const [from, to] = density.extent();
                  return to - from;
                }""");

        assertThat(number(length)).isBetween(29_900, 31_000);
    }

    @Test
    void countsRecordsOfTheNewestBucketFromBeforeThePageWasOpened(FarmPage farm) {
        Object newest = farm.run("""
                async () => {
                  const { LiveDensity } = await import('/timeline/live.js');
                  const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
                  const density = new LiveDensity(() => {});
                  await wait(density.width + 3000 - Date.now() % density.width); // some records are in it
                  const start = Math.floor(Date.now() / density.width) * density.width;
                  await density.request(start);
                  return density.counts.get(start);
                }""");

        assertThat(number(newest)).isPositive();
    }

    private static int number(Object value) {
        return ((Number) value).intValue();
    }
}
