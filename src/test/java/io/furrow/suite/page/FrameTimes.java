package io.furrow.suite.page;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Properties;

import com.google.gson.JsonElement;
import com.google.gson.JsonObject;
import com.microsoft.playwright.Browser;
import com.microsoft.playwright.BrowserContext;
import com.microsoft.playwright.CDPSession;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.options.ColorScheme;

/**
 * Measures the time of the browser's main thread per frame of the map, and of a bare page of OpenLayers for comparison.
 * Both play the same recorded stream of devices that report once a second, on maps of the same size, in turns. No suite
 * runs.
 */
final class FrameTimes implements AutoCloseable {
    static final String BARE = "bare";
    static final String MAP = "map";
    /** The map with the visible cards beside it. */
    static final String CARDS = "cards";

    private static final String WEB = "web";
    private static final String HARNESS = "/io/furrow/suite/page/frames/";
    private static final int WIDTH = 1440;
    private static final int PANEL = 372;
    private static final int MILLIS_BETWEEN_FRAMES = 50;
    private static final int FRAMES_IN_A_SECOND = 1000 / MILLIS_BETWEEN_FRAMES;
    private static final int SECONDS_RECORDED = 60;
    private static final int WARM_UP_MILLIS = 8_000;
    private static final int MAX_START_MILLIS = 120_000;
    /** The devices are so far apart that the map draws each one individually. */
    private static final int COLUMNS = 72;

    private static final double COLUMN_DEGREES = 0.0003;
    private static final double ROW_DEGREES = 0.0007;
    private static final Map<String, String> TYPES =
            Map.of("js", "text/javascript", "css", "text/css", "html", "text/html");

    private final Chromium chromium = Chromium.start();
    private final int devices;
    private final String recorded;

    FrameTimes(int devices) {
        this.devices = devices;
        this.recorded = recorded(devices);
    }

    /**
     * Measures one page.
     *
     * @param page {@link #BARE}, {@link #MAP} or {@link #CARDS}
     * @return milliseconds of the main thread per frame that the map drew
     * @throws IllegalStateException if a device was not drawn individually
     */
    double measure(String page, int seconds) {
        int width = page.equals(CARDS) ? WIDTH + PANEL : WIDTH; // the same size of the map
        try (BrowserContext context = chromium.browser()
                .newContext(new Browser.NewContextOptions()
                        .setViewportSize(width, 900)
                        .setColorScheme(ColorScheme.DARK))) {
            Page window = context.newPage();
            window.onPageError(error -> {
                throw new IllegalStateException(page + ": " + error);
            });
            window.route("**/*", this::answer);
            window.navigate("http://frames.test/frames/" + page + ".html");
            window.waitForFunction(
                    "(devices) => window.devices === devices",
                    devices,
                    new Page.WaitForFunctionOptions().setTimeout(MAX_START_MILLIS));
            window.waitForTimeout(WARM_UP_MILLIS);
            CDPSession session = context.newCDPSession(window);
            session.send("Performance.enable");
            double tasks = taskMillis(session);
            int drawn = drawn(window);
            window.waitForTimeout(seconds * 1000.0);
            double time = (taskMillis(session) - tasks) / (drawn(window) - drawn);
            requireAllDrawn(window, page);
            return time;
        }
    }

    private void requireAllDrawn(Page window, String page) {
        int single = page.equals(BARE)
                ? devices
                : ((Number) window.evaluate("document.querySelector('furrow-map').devices.spots.length")).intValue();
        if (single != devices) {
            throw new IllegalStateException(
                    "%s drew %d of %d devices individually: its time is not that of the same points"
                            .formatted(page, single, devices));
        }
    }

    private static int drawn(Page window) {
        return ((Number) window.evaluate("window.drawn")).intValue();
    }

    /** The time of the main thread until now. */
    static double taskMillis(CDPSession session) {
        for (JsonElement metric :
                session.send("Performance.getMetrics").get("metrics").getAsJsonArray()) {
            JsonObject each = metric.getAsJsonObject();
            if (each.get("name").getAsString().equals("TaskDuration")) {
                return each.get("value").getAsDouble() * 1000;
            }
        }
        throw new IllegalStateException("Chromium reports no TaskDuration");
    }

    // --- responses ---

    private void answer(Route route) {
        String path = URI.create(route.request().url()).getPath();
        Route.FulfillOptions answer = new Route.FulfillOptions();
        switch (path) {
            case "/frames/recorded" -> answer.setBody(recorded);
            case "/frames/extent" -> answer.setBody(extent());
            default -> {
                byte[] file = file(path);
                answer.setStatus(file == null ? 404 : 200).setBodyBytes(file == null ? new byte[0] : file);
                answer.setContentType(TYPES.getOrDefault(path.substring(path.lastIndexOf('.') + 1), "text/plain"));
            }
        }
        route.fulfill(answer);
    }

    private static byte[] file(String path) {
        if (path.startsWith("/frames/")) {
            return read(HARNESS + path.substring("/frames/".length()));
        }
        if (path.startsWith("/lib/ol/")) {
            String root = "/META-INF/resources/webjars/ol/" + openLayersVersion() + "/";
            String name = path.substring("/lib/ol/".length());
            byte[] distributed = read(root + "dist/" + name);
            return distributed == null ? read(root + name) : distributed;
        }
        return read("/" + WEB + path);
    }

    private static byte[] read(String resource) {
        try (InputStream stream = FrameTimes.class.getResourceAsStream(resource)) {
            return stream == null ? null : stream.readAllBytes();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static String openLayersVersion() {
        Properties properties = new Properties();
        try (InputStream stream =
                FrameTimes.class.getResourceAsStream("/META-INF/maven/org.webjars.npm/ol/pom.properties")) {
            properties.load(stream);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return properties.getProperty("version");
    }

    // --- the recorded stream ---

    /** Lines of a time in ms and a frame of records, as a dashboard's socket sends them. */
    private static String recorded(int devices) {
        StringBuilder lines = new StringBuilder();
        for (int frame = 0; frame < SECONDS_RECORDED * FRAMES_IN_A_SECOND; frame++) {
            List<String> records = new ArrayList<>();
            int within = frame % FRAMES_IN_A_SECOND;
            for (int number = within * devices / FRAMES_IN_A_SECOND;
                    number < (within + 1) * devices / FRAMES_IN_A_SECOND;
                    number++) {
                records.add(record(number, frame));
            }
            lines.append(frame * MILLIS_BETWEEN_FRAMES)
                    .append(" {\"records\":[")
                    .append(String.join(",", records))
                    .append("],\"merged\":0}\n");
        }
        return lines.toString();
    }

    private static String record(int number, int frame) {
        double angle = (frame / FRAMES_IN_A_SECOND + number) / 20.0;
        return String.format(
                Locale.ROOT,
                "{\"topic\":\"data.raw\",\"partition\":0,\"offset\":%d,\"kind\":\"event\",\"key\":\"urn:ngsi-ld:Tractor:%2$d\",\"time\":0,\"headers\":{},"
                        + "\"value\":{\"id\":\"urn:ngsi-ld:Tractor:%2$d\",\"type\":\"Tractor\",\"speed\":{\"type\":\"Float\",\"value\":%3$.2f},"
                        + "\"heading\":{\"type\":\"Float\",\"value\":%4$.1f},\"battery\":{\"type\":\"Float\",\"value\":0.8},"
                        + "\"Latitude\":{\"type\":\"Float\",\"value\":%5$.7f},\"Longitude\":{\"type\":\"Float\",\"value\":%6$.7f}}}",
                frame,
                number,
                1 + Math.sin(angle),
                Math.toDegrees(angle) % 360,
                40.31 + number / COLUMNS * ROW_DEGREES + 0.00005 * Math.sin(angle),
                -3.49 + number % COLUMNS * COLUMN_DEGREES + 0.00005 * Math.cos(angle));
    }

    /** West, south, east and north of all devices, degrees. */
    private String extent() {
        return String.format(
                Locale.ROOT,
                "[-3.4902,40.3098,%.4f,%.4f]",
                -3.4898 + COLUMNS * COLUMN_DEGREES,
                40.3102 + devices / COLUMNS * ROW_DEGREES);
    }

    @Override
    public void close() {
        chromium.close();
    }
}
