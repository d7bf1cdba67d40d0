package io.furrow.suite.page;

import java.util.Map;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Memory of a page that stays open. {@code ./furrow soak page --only heap} checks it with more devices, in real time.
 */
@PageTest
@Tag("full")
class HeapIT {
    private static final int DEVICES = 400;

    @Test
    void heapDoesNotGrowBetweenTheFirstAndFifthMinute(FarmPage farm) {
        // data that is read once does not count as growth: earlier reports, lists, alarms, and the first results of
        // analytics
        farm.untilStore(
                "store.primed && store.pastLoaded && store.alarmsLoaded && store.recordings.size > 0 && store.averages.size > 0"
                        + " && store.images.size > 0 && store.encounters.size > 0");
        report(farm, 0, 60);
        assertThat(farm.store("store.entities.size >= " + DEVICES)).isEqualTo(true);
        double afterOne = farm.heap();

        report(farm, 60, 300);

        assertThat(farm.heap()).isLessThanOrEqualTo(FarmPage.HEAP_GROWTH * afterOne);
    }

    /** Reports each device once per second of simulated time, which passes faster; the page draws in between. */
    private static void report(FarmPage farm, int from, int to) {
        farm.run("""
                async ({ devices, from, to }) => {
                  const { store } = await import('/core/store.js');
                  window.reportsBegan ??= Date.now() - 300_000;
                  for (let second = from; second < to; second++) {
                    for (let number = 0; number < devices; number++) {
                      const angle = (second + number) / 20;
                      const float = (value) => ({ type: 'Float', value });
                      const id = `urn:ngsi-ld:Tractor:${number}`;
                      store.applyEntity({
                        key: id, time: window.reportsBegan + 1000 * second, headers: {},
                        value: {
                          id, type: 'Tractor', speed: float(1 + Math.sin(angle)), heading: float((angle * 57.3) % 360), battery: float(0.8),
                          Latitude: float(40.31 + Math.floor(number / 40) * 0.0002 + 0.00005 * Math.sin(angle)),
                          Longitude: float(-3.49 + (number % 40) * 0.0003 + 0.00005 * Math.cos(angle)),
                        },
                      });
                    }
                    second % 5 === 4 && await new Promise(requestAnimationFrame);
                  }
                }""", Map.of("devices", DEVICES, "from", from, "to", to));
    }
}
