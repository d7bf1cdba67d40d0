package io.furrow.suite.page;

import java.net.URI;
import java.util.List;

import com.microsoft.playwright.Browser;
import com.microsoft.playwright.Page;

/** Measures how long the page of a running farm takes to open. */
public final class OpeningTime {
    private static final String IS_SHOWN = """
            async (ids) => {
              const { store } = await import('/core/store.js');
              const frame = document.querySelector('furrow-map canvas.map-canvas');
              return frame !== null && ids.every((id) => store.entities.get(id)?.position
                && document.querySelector(`furrow-cards li.card[data-id="${id}"]`) !== null);
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
            farm.until(
                    () -> Boolean.TRUE.equals(farm.run(IS_SHOWN, devices)),
                    new Page.WaitForConditionOptions().setTimeout(20_000));
            return (System.nanoTime() - startedAt) / 1_000_000;
        }
    }
}
