package io.furrow.suite.page;

import java.net.URI;
import java.util.List;

import com.microsoft.playwright.Browser;

/** Measures how long the page of a running farm takes to open. */
public final class OpeningTime {
    private static final String UNTIL_SHOWN = """
            async (ids) => {
              const { store } = await import('/core/store.js');
              const isShown = () => document.querySelector('furrow-map canvas.map-canvas') !== null
                && ids.every((id) => store.entities.get(id)?.position && document.querySelector(`furrow-cards li.card[data-id="${id}"]`) !== null);
              while (!isShown()) {
                if (performance.now() > 20_000) {
                  throw new Error('not all devices are shown after 20 s');
                }
                await new Promise(requestAnimationFrame);
              }
            }""";

    private OpeningTime() {}

    /** @param devices that must be on the map and among the cards @return ms from the navigation of a new window */
    public static long millis(URI dashboard, List<String> devices) {
        try (Chromium chromium = Chromium.start();
                FarmPage farm = new FarmPage(
                        dashboard,
                        chromium.browser()
                                .newContext(new Browser.NewContextOptions()
                                        .setViewportSize(WindowStyle.DESKTOP.width(), WindowStyle.DESKTOP.height())))) {
            long startedAt = System.nanoTime();
            farm.open("");
            farm.run(UNTIL_SHOWN, devices);
            return (System.nanoTime() - startedAt) / 1_000_000;
        }
    }
}
