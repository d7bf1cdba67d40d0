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

/** A suite with the demonstration farm, its dashboard and a browser, shared by all tests of the page. */
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

    /** Starts another dashboard beside the suite's, which all tests share. */
    Dashboard ownDashboard(int port) throws IOException {
        return Dashboard.start(DashboardSettings.of(
                port,
                running.suite().kafka().clientProperties(),
                running.suite().control()));
    }

    /** Writes a record as any client with write access to Kafka could. */
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

    /**
     * Deletes an entity that no context broker has, on both topics: on {@code data.raw} alone a tombstone does not
     * report a deletion.
     */
    void forget(String entity) throws Exception {
        produce("data.raw", entity, null);
        produce("data.latest", entity, null);
    }

    JsonNode rest(String path) throws Exception {
        return running.get(path);
    }

    /** The status of a response of the control plane's REST API. */
    int rest(String method, String path, String body) throws Exception {
        return running.request(method, path, body).statusCode();
    }

    /** Opens the page in a new window without stored data. */
    FarmPage open(String hash) {
        return open(hash, WindowStyle.DESKTOP);
    }

    FarmPage open(String hash, WindowStyle style) {
        return open(running.suite().dashboard(), hash, style);
    }

    FarmPage open(URI dashboard, String hash, WindowStyle style) {
        return window(dashboard, style).open(hash);
    }

    /** A new window without a page. */
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
