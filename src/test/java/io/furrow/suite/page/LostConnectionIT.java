package io.furrow.suite.page;

import java.net.URI;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.WebSocketRoute;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.Dashboard;
import io.furrow.model.ngsi.NgsiJson;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** The dashboard stops, and starts again. */
@PageTest
@Tag("full")
class LostConnectionIT {
    private static final String COLLISIONS = "store.topics.get('data.collision')";

    @Test
    void retainsItsStateAndReconnects(PageSuite suite) throws Exception {
        Dashboard dashboard = suite.ownDashboard(0);
        int port = dashboard.uri().getPort();
        FarmPage farm = suite.open(dashboard.uri(), "", WindowStyle.DESKTOP)
                .expectingError("ERR_CONNECTION|WebSocket connection|Failed to load resource|Failed to fetch");
        farm.untilStore("store.entities.size >= 17");

        dashboard.close();
        assertThat(farm.find(".notice")).containsText("trying again. The data shown is from");
        assertThat(farm.card("urn:ngsi-ld:Robot:1")).isVisible();

        try (Dashboard restarted = suite.ownDashboard(port)) {
            Assertions.assertThat(restarted.uri()).hasPort(port);
            assertThat(farm.find(".notice"))
                    .hasText(Pattern.compile("^The connection was lost from [\\d:]{8} to [\\d:]{8}\\."));
            assertThat(farm.find(".notice")).isHidden();
            farm.untilStore("store.entities.get('urn:ngsi-ld:Robot:1').time > " + System.currentTimeMillis());
            farm.close();
        }
    }

    /** The server continues its sequence, since another page reads the topic all the time. */
    @Test
    void countsMissedRecords(PageSuite suite) {
        FarmPage other = suite.open("");
        FarmPage farm = suite.window().expectingError("ERR_FAILED|Failed to load resource");
        farm.page().addInitScript("""
                window.sockets = [];
                window.WebSocket = class extends WebSocket {
                  constructor(...address) {
                    super(...address);
                    window.sockets.push(this);
                  }
                };""");
        farm.open("");
        farm.untilStore(COLLISIONS + ".count > 0");

        farm.page().route("**/api/register/**", Route::abort);
        farm.run("sockets.forEach((socket) => socket.close())");
        assertThat(farm.find(".notice")).containsText("trying again");
        int previous = (int) other.store(COLLISIONS + ".count");
        other.untilStore(COLLISIONS + ".count > " + (previous + 2));
        farm.page().unroute("**/api/register/**");

        farm.untilStore(COLLISIONS + ".gap > 2");
    }

    /** The notice says how many records were missed; it would grow while streams return one after the other. */
    @Test
    void reconnectsAllStreamsAtOnce(PageSuite suite) {
        List<WebSocketRoute> open = new ArrayList<>();
        FarmPage farm = withMockedServer(suite, Map.of(), open).expectingError("ERR_FAILED|Failed to load resource");
        farm.page().route("**/api/history/**", EmptyFarmIT::answerEmpty);
        farm.open("");
        farm.untilStore("[...store.topics.values()].filter((each) => each.state === 'open').length > 6");

        Consumer<Route> refusal = Route::abort;
        farm.page().route("**/api/register/**", refusal);
        farm.store("""
                (() => {
                  const lost = [...store.topics.values()].filter((each) => each.state === 'open');
                  Object.assign(window, { lost, lostAt: Date.now() });
                  store.on('topics', () => lost.forEach((each) => {
                    each.wasLost ||= each.state !== 'open';
                    each.state === 'open' && each.wasLost && (each.openedAt ??= Date.now());
                  }));
                })()""");
        List.copyOf(open).forEach(WebSocketRoute::close);
        // until the intervals between attempts have grown
        farm.untilStore("Date.now() - lostAt > 12_000");
        farm.page().unroute("**/api/register/**", refusal);

        farm.untilStore("lost.every((each) => each.openedAt)");
        Assertions.assertThat(
                        (List<?>)
                                farm.store(
                                        "lost.filter((each) => each.openedAt - Math.min(...lost.map(({ openedAt }) => openedAt)) > 2_500).map(({ name }) => name)"))
                .isEmpty();
    }

    /** The initial state contains no deletions, and lags behind the reports of entities. */
    @Test
    void removesWhatWasDeletedMeanwhile(PageSuite suite) {
        Map<String, List<String>> state = new HashMap<>();
        state.put("data.raw", entities("stays", "gone"));
        state.put("service.fields", fields("stays", "gone"));
        state.put("service.alarms", alarms("stays", "gone"));
        state.put("service.replays", replays("stays", "gone"));
        state.put("service.replays.status", replays("stays", "gone"));
        List<WebSocketRoute> open = new ArrayList<>();
        FarmPage farm = withMockedServer(suite, state, open);
        farm.page().route("**/api/history/**", EmptyFarmIT::answerEmpty);
        farm.open("");
        String shown =
                "[store.entities, store.fields, store.alarms, store.replays].map((each) => [...each.keys()].sort())";
        farm.untilStore(shown + ".every((each) => each.join() === 'gone,stays')");
        send(open, "data.raw", List.of(record("event", "new", 2_000, "{\"id\":\"new\",\"type\":\"Robot\"}")));
        farm.untilStore("store.entities.has('new')");

        state.put("data.raw", entities("stays"));
        state.put("service.fields", fields("stays"));
        state.put("service.alarms", alarms("stays"));
        state.put("service.replays", replays("stays"));
        state.put("service.replays.status", replays("stays"));
        List.copyOf(open).forEach(WebSocketRoute::close);

        farm.untilStore(
                "JSON.stringify(" + shown + ") === '[[\"new\",\"stays\"],[\"stays\"],[\"stays\"],[\"stays\"]]'");
    }

    @Test
    void readsResultsOfAnalyticsFromMeanwhile(PageSuite suite) throws Exception {
        Map<String, String> found = new HashMap<>();
        List<WebSocketRoute> open = new ArrayList<>();
        FarmPage farm = withMockedServer(suite, Map.of(), open);
        farm.page().route("**/api/history/**", route -> {
            String topic = URI.create(route.request().url()).getPath().substring("/api/history/".length());
            route.fulfill(new Route.FulfillOptions()
                    .setContentType("application/json")
                    .setBody("{\"since\":0,\"records\":[" + found.getOrDefault(topic, "") + "]}"));
        });
        farm.open("#/analyses");
        String[] parts = {"averages", "encounters", "presence"};
        for (String part : parts) {
            assertThat(farm.find(".analysis." + part + " .empty")).isVisible();
        }
        farm.until(() -> farm.is(
                "document.querySelector('furrow-analyses').findings.streams.every((each) => each.state === 'open')"));

        long now = System.currentTimeMillis();
        found.put("data.temperature", result("Analytics:FieldTemperature", """
                {"field": "north", "averageTemperature": 21.5, "windowStart": %d, "windowEnd": %d}""", now - 10_000, now));
        found.put("data.collision", result("Analytics:Collision", """
                {"phase": "ended", "Device1_ID": "a", "Device2_ID": "b", "minDistance": 2, "startTime": %d, "time": %d}""", now - 5_000, now));
        found.put("data.presence", result("Analytics:Presence", """
                {"stay": "s", "device": "a", "field": "north", "phase": "entered", "startTime": %d}""", now - 5_000));
        List.copyOf(open).forEach(WebSocketRoute::close);

        for (String part : parts) {
            assertThat(farm.find(".analysis." + part + " > .row .numbers").first())
                    .hasText("1");
        }
    }

    /** A window with mocked streams and responses: each stream begins with the current state of its topic. */
    private static FarmPage withMockedServer(
            PageSuite suite, Map<String, List<String>> state, List<WebSocketRoute> open) {
        FarmPage farm = suite.window();
        farm.page().route("**/api/**", EmptyFarmIT::answerEmpty);
        farm.page()
                .route(
                        "**/api/topics*",
                        route -> route.fulfill(
                                new Route.FulfillOptions()
                                        .setContentType("application/json")
                                        .setBody(
                                                "[{\"name\":\"data.temperature\"},{\"name\":\"data.collision\"},{\"name\":\"data.presence\"}]")));
        farm.page()
                .route(
                        "**/api/register/**",
                        route -> route.fulfill(new Route.FulfillOptions()
                                .setContentType("application/json")
                                .setBody("{\"socket\":\"/socket/"
                                        + topicOf(route.request().url()) + "\"}")));
        farm.page().routeWebSocket("**/socket/**", socket -> {
            open.add(socket);
            send(List.of(socket), topicOf(socket.url()), state.getOrDefault(topicOf(socket.url()), List.of()));
            socket.send("{\"primed\":true}");
        });
        return farm;
    }

    private static void send(List<WebSocketRoute> sockets, String topic, List<String> records) {
        sockets.stream()
                .filter(socket -> topicOf(socket.url()).equals(topic))
                .forEach(socket -> socket.send("{\"records\":[" + String.join(",", records) + "]}"));
    }

    private static String topicOf(String url) {
        String path = URI.create(url).getPath();
        return path.substring(path.lastIndexOf('/') + 1);
    }

    private static List<String> entities(String... ids) {
        return records(ids, "%1$s", "{\"id\":\"%1$s\",\"type\":\"Robot\"}");
    }

    private static List<String> fields(String... ids) {
        return records(
                ids,
                "%1$s@2026-01-01T00:00:00.000Z",
                "{\"id\":\"%1$s\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\","
                        + "\"coordinates\":[[[9.0,50.0],[9.001,50.0],[9.001,50.001],[9.0,50.0]]]}}");
    }

    private static List<String> alarms(String... ids) {
        return records(
                ids,
                "%1$s",
                "{\"alarm\":\"%1$s\",\"kind\":\"silent-device\",\"severity\":\"minor\",\"text\":\"%1$s is silent\",\"subject\":\"%1$s\","
                        + "\"raised\":1,\"count\":1,\"state\":\"open\"}");
    }

    private static List<String> replays(String... ids) {
        return records(
                ids,
                "%1$s",
                "{\"replay\":\"%1$s\",\"mission\":\"weeding\",\"topic\":\"data.weeding.replay.%1$s\",\"state\":\"running\"}");
    }

    private static List<String> records(String[] ids, String key, String value) {
        return Stream.of(ids)
                .map(id -> record("prime", key.formatted(id), 1_000, value.formatted(id)))
                .toList();
    }

    private static String record(String kind, String key, long time, String value) {
        return """
                {"kind": "%s", "key": "%s", "time": %d, "headers": {}, "value": %s}""".formatted(kind, key, time, value);
    }

    private static String result(String type, String attributes, Object... times) throws Exception {
        ObjectNode value = JsonNodeFactory.instance.objectNode().put("type", type);
        NgsiJson.mapper()
                .readTree(attributes.formatted(times))
                .properties()
                .forEach(each -> value.putObject(each.getKey()).set("value", each.getValue()));
        return record("event", "any", System.currentTimeMillis(), value.toString());
    }
}
