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

/** The dashboard in one window of the browser: how to move about in it, and what went wrong in it. */
final class FarmPage implements AutoCloseable {
    /** Of what comes of its own accord, such as the next encounter. */
    static final Page.WaitForConditionOptions TIMEOUT = new Page.WaitForConditionOptions().setTimeout(60_000);

    /** How many times as much a page may hold after five minutes as after one. */
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
        // What the page's policy forbids is an event besides a line on the console, which others could phrase
        // otherwise.
        context.addInitScript(
                "addEventListener('securitypolicyviolation', (event) => console.error("
                        + "`policy forbids ${event.violatedDirective} of ${event.blockedURI} at ${event.sourceFile}:${event.lineNumber}`));");
    }

    private void listen(ConsoleMessage message) {
        if (message.type().equals("error")) {
            errors.add(message.text() + " (" + message.location() + ")");
        }
    }

    /** @param place as in {@code #/missions} */
    FarmPage open(String place) {
        page.navigate(dashboard.resolve("/") + place);
        assertThat(page.locator("furrow-app")).isVisible();
        return this;
    }

    /** By the rail, as one who clicks. */
    FarmPage go(String name) {
        page.getByRole(AriaRole.NAVIGATION, new Page.GetByRoleOptions().setName("Places"))
                .getByRole(AriaRole.LINK, new Locator.GetByRoleOptions().setName(name))
                .click();
        return this;
    }

    Page page() {
        return page;
    }

    /** The value of an expression or function of JavaScript. */
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

    /** As a tab behind another one. */
    void hide() {
        seen(false);
    }

    void show() {
        seen(true);
    }

    private void seen(boolean visible) {
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

    /** Of the page's own store: an expression over {@code store}. */
    Object store(String expression) {
        return page.evaluate(
                "async () => { const { store } = await import('/core/store.js'); return " + expression + "; }");
    }

    /**
     * MiB that its scripts hold, memory of typed arrays counted in: the smallest of several garbage collections. After a single one half
     * a MiB may be on its way, an answer that was just read or memory whose owner is freed by the next one. What is held is in all of them.
     */
    double heap() {
        CDPSession session = context.newCDPSession(page);
        try {
            double smallest = Double.MAX_VALUE;
            for (int collection = 0; collection < HEAP_COLLECTIONS; collection++) {
                session.send("HeapProfiler.collectGarbage");
                JsonObject usage = session.send("Runtime.getHeapUsage");
                smallest = Math.min(
                        smallest,
                        usage.get("usedSize").getAsDouble()
                                + usage.get("backingStorageSize").getAsDouble());
                page.waitForTimeout(HEAP_COLLECTION_MILLIS);
            }
            return smallest / (1 << 20);
        } finally {
            session.detach();
        }
    }

    /** Waits until an expression over {@code store} is true. */
    void untilStore(String expression) {
        page.waitForCondition(() -> Boolean.TRUE.equals(store(expression)), TIMEOUT);
    }

    /** Where on the map a device is drawn, pixels of the window. */
    double[] spot(String entity) {
        List<?> pixel = (List<?>) page.evaluate(
                "async (id) => { const { store } = await import('/core/store.js'); const { project } = await import('/map/projection.js');"
                        + " const map = document.querySelector('furrow-map'); const box = map.target.getBoundingClientRect();"
                        + " const [x, y] = map.map.getPixelFromCoordinate(project(...store.entities.get(id).position));"
                        + " return [x + box.left, y + box.top]; }",
                entity);
        return new double[] {((Number) pixel.get(0)).doubleValue(), ((Number) pixel.get(1)).doubleValue()};
    }

    /** Where it is drawn once no other device is drawn there with it. */
    double[] ownSpot(String entity) {
        page.waitForFunction(
                "async (id) => { const { store } = await import('/core/store.js'); const { project } = await import('/map/projection.js');"
                        + " const { devices, map } = document.querySelector('furrow-map');"
                        + " const pixel = map.getPixelFromCoordinate(project(...store.entities.get(id).position));"
                        + " return devices.at(...pixel)?.entity?.id === id; }",
                entity);
        return spot(entity);
    }

    /** Pixels of the map's canvases that have exactly a colour. */
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

    /** An error that a test provokes is no failure of the page. */
    FarmPage expectingError(String pattern) {
        expected.add(Pattern.compile(pattern));
        return this;
    }

    /** What the console called an error, was thrown and not caught, or the page's policy forbade. */
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
            page.unrouteAll(); // a request that comes while the page closes would otherwise fail the test
        }
        context.close();
    }
}
