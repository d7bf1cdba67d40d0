package io.furrow.suite.page;

import java.net.URI;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.BooleanSupplier;
import java.util.regex.Pattern;

import com.google.gson.JsonObject;
import com.microsoft.playwright.BrowserContext;
import com.microsoft.playwright.CDPSession;
import com.microsoft.playwright.ConsoleMessage;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.options.AriaRole;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** The dashboard in one browser window: navigates in it, queries it, and collects its errors. */
final class FarmPage implements AutoCloseable {
    /** Timeout for events that the test does not trigger, such as the next encounter. */
    static final Page.WaitForConditionOptions TIMEOUT = new Page.WaitForConditionOptions().setTimeout(60_000);

    /** Accepted ratio of the heap after five minutes to the heap after one minute. */
    static final double HEAP_GROWTH = 1.1;

    static final Locator.GetByTextOptions EXACTLY = new Locator.GetByTextOptions().setExact(true);
    static final Locator.GetByRoleOptions ATTRIBUTES = new Locator.GetByRoleOptions().setName("All attributes of");

    private static final int HEAP_COLLECTIONS = 8;
    private static final int HEAP_COLLECTION_MILLIS = 250;

    private final URI dashboard;
    private final BrowserContext context;
    private final Page page;
    private final List<String> errors = new ArrayList<>();
    private final List<Pattern> expected = new ArrayList<>();

    FarmPage(URI dashboard, BrowserContext context) {
        this.dashboard = dashboard;
        this.context = context;
        this.page = context.newPage();
        page.onConsoleMessage(this::listen);
        page.onPageError(error -> errors.add("uncaught: " + error));
        // the console also reports violations of the policy, but their wording depends on the browser
        context.addInitScript(
                "addEventListener('securitypolicyviolation', (event) => console.error("
                        + "`policy forbids ${event.violatedDirective} of ${event.blockedURI} at ${event.sourceFile}:${event.lineNumber}`));");
    }

    private void listen(ConsoleMessage message) {
        if (message.type().equals("error")) {
            errors.add(message.text() + " (" + message.location() + ")");
        }
    }

    /** @param hash such as {@code #/missions} */
    FarmPage open(String hash) {
        page.navigate(dashboard.resolve("/") + hash);
        assertThat(page.locator("furrow-app")).isVisible();
        return this;
    }

    /** Opens a view by a click in the navigation. */
    FarmPage go(String name) {
        page.getByRole(AriaRole.NAVIGATION, new Page.GetByRoleOptions().setName("Places"))
                .getByRole(AriaRole.LINK, new Locator.GetByRoleOptions().setName(name))
                .click();
        return this;
    }

    Page page() {
        return page;
    }

    /** Evaluates an expression or function of JavaScript. */
    Object run(String script) {
        return page.evaluate(script);
    }

    Object run(String script, Object argument) {
        return page.evaluate(script, argument);
    }

    boolean is(String script) {
        return Boolean.TRUE.equals(run(script));
    }

    double number(String script) {
        return ((Number) run(script)).doubleValue();
    }

    void until(BooleanSupplier condition) {
        page.waitForCondition(condition);
    }

    void until(BooleanSupplier condition, Page.WaitForConditionOptions options) {
        page.waitForCondition(condition, options);
    }

    static Locator.FilterOptions having(String text) {
        return new Locator.FilterOptions().setHasText(text);
    }

    Locator find(String selector) {
        return page.locator(selector);
    }

    Locator button(String name) {
        return page.getByRole(
                AriaRole.BUTTON, new Page.GetByRoleOptions().setName(name).setExact(true));
    }

    /** Hides the window like a tab in the background. */
    void hide() {
        setVisible(false);
    }

    void show() {
        setVisible(true);
    }

    private void setVisible(boolean visible) {
        page.evaluate("""
                (visible) => {
                  Object.defineProperty(document, 'hidden', { get: () => !visible, configurable: true });
                  Object.defineProperty(document, 'visibilityState', { get: () => (visible ? 'visible' : 'hidden'), configurable: true });
                  document.dispatchEvent(new Event('visibilitychange'));
                }""", visible);
    }

    /** The card of a device. */
    Locator card(String entity) {
        return page.locator("furrow-cards li.card[data-id=\"" + entity + "\"]");
    }

    /** Evaluates an expression over {@code store}, the page's store. */
    Object store(String expression) {
        return page.evaluate(
                "async () => { const { store } = await import('/core/store.js'); return " + expression + "; }");
    }

    /**
     * The memory of the page's scripts including typed arrays, MiB: the minimum after several garbage collections.
     * After a single one, half a MiB may be temporary, such as a response that was just read, or memory whose owner is
     * freed by the next collection.
     */
    double heap() {
        CDPSession session = context.newCDPSession(page);
        try {
            double min = Double.MAX_VALUE;
            for (int collection = 0; collection < HEAP_COLLECTIONS; collection++) {
                session.send("HeapProfiler.collectGarbage");
                JsonObject usage = session.send("Runtime.getHeapUsage");
                min = Math.min(
                        min,
                        usage.get("usedSize").getAsDouble()
                                + usage.get("backingStorageSize").getAsDouble());
                page.waitForTimeout(HEAP_COLLECTION_MILLIS);
            }
            return min / (1 << 20);
        } finally {
            session.detach();
        }
    }

    /** Waits until an expression over {@code store} is true. */
    void untilStore(String expression) {
        page.waitForCondition(() -> Boolean.TRUE.equals(store(expression)), TIMEOUT);
    }

    /** Where a device is drawn on the map, pixels of the window. */
    double[] spot(String entity) {
        List<?> pixel = (List<?>) page.evaluate(
                "async (id) => { const { store } = await import('/core/store.js'); const { project } = await import('/map/projection.js');"
                        + " const map = document.querySelector('furrow-map'); const box = map.target.getBoundingClientRect();"
                        + " const [x, y] = map.map.getPixelFromCoordinate(project(...store.entities.get(id).position));"
                        + " return [x + box.left, y + box.top]; }",
                entity);
        return new double[] {((Number) pixel.get(0)).doubleValue(), ((Number) pixel.get(1)).doubleValue()};
    }

    /** Where a device is drawn, once no other device is drawn at the same spot. */
    double[] ownSpot(String entity) {
        page.waitForFunction(
                "async (id) => { const { store } = await import('/core/store.js'); const { project } = await import('/map/projection.js');"
                        + " const { devices, map } = document.querySelector('furrow-map');"
                        + " const pixel = map.getPixelFromCoordinate(project(...store.entities.get(id).position));"
                        + " return devices.at(...pixel)?.entity?.id === id; }",
                entity);
        return spot(entity);
    }

    /** The number of pixels on the map's canvases with exactly this color. */
    int mapPixels(int rgb) {
        return ((Number) page.evaluate("""
                        (rgb) => [...document.querySelectorAll('furrow-map canvas.map-canvas')].reduce((sum, canvas) => {
                          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
                          for (let i = 0; i < data.length; i += 4) {
                            sum += data[i + 3] === 255 && (data[i] << 16 | data[i + 1] << 8 | data[i + 2]) === rgb;
                          }
                          return sum;
                        }, 0)""", rgb)).intValue();
    }

    /** Expects an error that the test provokes, so that it does not fail the test. */
    FarmPage expectingError(String pattern) {
        expected.add(Pattern.compile(pattern));
        return this;
    }

    /**
     * Errors on the console, uncaught exceptions, and violations of the content security policy, except expected ones.
     */
    List<String> errors() {
        return errors.stream()
                .filter(error -> expected.stream()
                        .noneMatch(pattern -> pattern.matcher(error).find()))
                .toList();
    }

    List<String> allErrors() {
        return List.copyOf(errors);
    }

    void screenshot(Path file) {
        page.screenshot(new Page.ScreenshotOptions().setPath(file));
    }

    @Override
    public void close() {
        if (!page.isClosed()) {
            page.unrouteAll(); // a request that arrives while the page closes would fail the test
        }
        context.close();
    }
}
