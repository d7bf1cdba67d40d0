package io.furrow.suite.page;

import java.io.IOException;
import java.net.URI;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Browser;
import com.microsoft.playwright.assertions.PlaywrightAssertions;
import com.microsoft.playwright.options.ReducedMotion;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.dashboard.Dashboard;
import io.furrow.dashboard.DashboardSettings;
import io.furrow.launcher.command.DemoFarm;
import io.furrow.suite.RunningSuite;

import static java.nio.charset.StandardCharsets.UTF_8;

/** A suite with the demonstration farm, its dashboard and a browser, for all tests of the page. */
final class PageSuite implements AutoCloseable {
    static final double TIMEOUT_MILLIS = 30_000;

    private final RunningSuite running;
    private final Chromium chromium;
    private final List<FarmPage> pages = new ArrayList<>();

    private PageSuite(RunningSuite running) {
        this.running = running;
        this.chromium = Chromium.start();
    }

    static PageSuite start() throws Exception {
        PlaywrightAssertions.setDefaultAssertionTimeout(TIMEOUT_MILLIS);
        RunningSuite running = RunningSuite.start(null);
        DemoFarm.start(running.suite().control());
        return new PageSuite(running);
    }

    RunningSuite running() {
        return running;
    }

    /** Beside that of the suite, which all tests share. */
    Dashboard ownDashboard(int port) throws IOException {
        return Dashboard.start(DashboardSettings.of(
                port,
                running.suite().kafka().clientProperties(),
                running.suite().control()));
    }

    /** Writes a record as anybody could who may write to Kafka. */
    void produce(String topic, String key, byte[] value) throws Exception {
        produce(topic, key, value, Instant.now());
    }

    void produce(String topic, String key, byte[] value, Instant time) throws Exception {
        Properties properties = running.suite().kafka().clientProperties();
        properties.setProperty("max.request.size", "10000000");
        try (var producer = new KafkaProducer<>(properties, new ByteArraySerializer(), new ByteArraySerializer())) {
            producer.send(new ProducerRecord<>(topic, null, time.toEpochMilli(), key.getBytes(UTF_8), value))
                    .get();
        }
    }

    /** Deletes an entity that no context broker has: its record alone is not a report that it was deleted there. */
    void forget(String entity) throws Exception {
        produce("data.raw", entity, null);
        produce("data.latest", entity, null);
    }

    JsonNode rest(String path) throws Exception {
        return running.get(path);
    }

    /** The status of an answer of the control plane's REST API. */
    int rest(String method, String path, String body) throws Exception {
        return running.request(method, path, body).statusCode();
    }

    /** A new window with nothing remembered. */
    FarmPage open(String place) {
        return open(place, WindowStyle.DESKTOP);
    }

    FarmPage open(String place, WindowStyle style) {
        return open(running.suite().dashboard(), place, style);
    }

    FarmPage open(URI dashboard, String place, WindowStyle style) {
        return window(dashboard, style).open(place);
    }

    /** With nothing in it yet. */
    FarmPage window() {
        return window(running.suite().dashboard(), WindowStyle.DESKTOP);
    }

    FarmPage window(URI dashboard, WindowStyle style) {
        FarmPage page = new FarmPage(
                dashboard,
                chromium.browser()
                        .newContext(new Browser.NewContextOptions()
                                .setViewportSize(style.width(), style.height())
                                .setColorScheme(style.scheme())
                                .setReducedMotion(ReducedMotion.REDUCE)
                                .setLocale("en-GB")
                                .setTimezoneId("Europe/Madrid")));
        pages.add(page);
        return page;
    }

    List<FarmPage> pages() {
        return List.copyOf(pages);
    }

    void closePages() {
        pages.forEach(FarmPage::close);
        pages.clear();
    }

    @Override
    public void close() {
        chromium.close();
        running.close();
    }
}
