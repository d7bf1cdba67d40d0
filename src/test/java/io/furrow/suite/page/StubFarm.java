package io.furrow.suite.page;

import java.net.URI;
import java.net.URLDecoder;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import com.microsoft.playwright.Browser;
import com.microsoft.playwright.Route;
import com.microsoft.playwright.WebSocketRoute;
import com.microsoft.playwright.options.ReducedMotion;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.component.LifeCycle;

import io.furrow.dashboard.page.PageFiles;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** The page in a real browser on a farm of stubs: its records and responses are those of the test. Starts in a second. */
final class StubFarm implements AutoCloseable {
    private static final Pattern CODED = Pattern.compile("([a-z-]+): (.*)");

    private final Chromium chromium;
    private final Server server = new Server();
    private final URI uri;
    private String locale = "en-GB";
    private final Map<String, List<String>> initial = new HashMap<>();
    private final Map<String, String> answers = new ConcurrentHashMap<>();
    private final Map<String, WebSocketRoute> sockets = new ConcurrentHashMap<>();
    private final List<String> sent = new CopyOnWriteArrayList<>();
    private final List<FarmPage> pages = new ArrayList<>();
    private String config = "";

    StubFarm(Chromium chromium) throws Exception {
        this.chromium = chromium;
        ServerConnector connector = new ServerConnector(server);
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        server.setHandler(PageFiles.handler(null));
        server.start();
        uri = URI.create("http://127.0.0.1:" + connector.getLocalPort());
    }

    /** Adds a record to the initial state of a topic. */
    StubFarm has(String topic, String key, String value) {
        return has(topic, key, value, System.currentTimeMillis());
    }

    StubFarm has(String topic, String key, String value, long time) {
        initial.computeIfAbsent(topic, each -> new ArrayList<>()).add(record("prime", topic, key, value, time));
        return this;
    }

    /** Adds members to the settings of the page, such as {@code "tiles": "/tiles/{z}/{x}/{y}"}. */
    StubFarm configures(String members) {
        config = ", " + members;
        return this;
    }

    /** Adds a robot that reports. */
    StubFarm hasRobot(int number) {
        return has("data.raw", "urn:ngsi-ld:Robot:" + number, robot(number, "Running"));
    }

    static String robot(int number, String state) {
        return robot(number, state, "farm", "weeding", 40.3125 + number * 1e-4, -3.4822);
    }

    static String robot(int number, String state, String domain, String mission, double latitude, double longitude) {
        return """
                {"id": "urn:ngsi-ld:Robot:%d", "type": "ROBOT", "Domain": {"value": "%s"}, "Mission": {"value": "%s"}, "state": {"value": "%s"},
                 "Latitude": {"value": %s}, "Longitude": {"value": %s}, "speed": {"value": 1.5}, "cmd": {"value": ""}}""".formatted(number, domain, mission, state, latitude, longitude);
    }

    /** Adds a triangular field, its sides some 100 m long. */
    StubFarm hasField(String id, String domain, double longitude, double latitude) {
        return has("service.fields", id + "@2020-01-01T00:00:00Z", """
                {"properties": {"name": "%s", "Domain": "%s"}, "geometry": {"type": "Polygon", "coordinates": [[[%3$s, %5$s], [%4$s, %5$s], [%4$s, %6$s], [%3$s, %5$s]]]}}""".formatted(
                        id, domain, longitude, longitude + 0.001, latitude, latitude + 0.001));
    }

    /** Adds open alarms with the keys {@code a1}, {@code a2} … */
    StubFarm hasAlarms(int count) {
        for (int number = 1; number <= count; number++) {
            has("service.alarms", "a" + number, alarm(number, "warning", "open"));
        }
        return this;
    }

    static String alarm(int number, String severity, String state) {
        return """
                {"alarm": "a%d", "kind": "silent-device", "severity": "%s", "text": "Thermometer %d is silent", "subject": "t", "raised": %d, "count": 1, "state": "%s"}""".formatted(number, severity, number, 1_000_000 - number, state);
    }

    /** Adds a replay of a robot. @param group empty for a single replay @param times epoch ms: from, to and position */
    StubFarm hasReplay(String mission, String group, String state, long... times) {
        String topic = "data.farm.replay." + mission + ".1";
        String member = group.isEmpty() ? "" : ", \"group\": \"" + group + "\"";
        return has("service.replays", mission + ".1", """
                        {"replay": "%1$s.1", "mission": "%1$s", "topic": "%2$s", "speed": 1, "analytics": ["collision"]%3$s}""".formatted(mission, topic, member))
                .has("service.replays.status", mission + ".1", """
                        {"state": "%s", "progress": {"from": %d, "to": %d, "position": %d}}""".formatted(state, times[0], times[1], times[2]))
                .has(topic, "urn:ngsi-ld:Robot:1", robot(1, "Running"), times[2]);
    }

    /** Answers a path with JSON; {@code 409 reason} or {@code 409 code: reason}, for example, with that status; an empty text never. */
    StubFarm answers(String path, String answer) {
        answers.put(path, answer);
        return this;
    }

    /** Sets the language of the browser. */
    StubFarm isReadIn(String newLocale) {
        locale = newLocale;
        return this;
    }

    FarmPage open(String hash, int width, int height) {
        FarmPage page = new FarmPage(
                uri,
                chromium.browser()
                        .newContext(new Browser.NewContextOptions()
                                .setViewportSize(width, height)
                                .setReducedMotion(ReducedMotion.REDUCE)
                                .setLocale(locale)
                                .setTimezoneId("Europe/Madrid")));
        pages.add(page);
        page.page()
                .route(
                        "**/config.json",
                        route -> json(
                                route,
                                "{\"analytics\": [\"collision\", \"temperature\", \"presence\"]" + config + "}"));
        page.page().route("**/api/**", this::answer);
        page.page().routeWebSocket("**/socket/*", socket -> {
            String topic = socket.url().substring(socket.url().lastIndexOf('/') + 1);
            sockets.put(topic, socket);
            socket.send("{\"records\": " + initial.getOrDefault(topic, List.of()) + "}");
            socket.send("{\"primed\": true}");
        });
        return page.open(hash);
    }

    private void answer(Route route) {
        String path = URLDecoder.decode(URI.create(route.request().url()).getRawPath(), UTF_8);
        if (!route.request().method().equals("GET")) {
            sent.add(route.request().method() + " " + path + " "
                    + route.request().postData());
        }
        String topic = path.substring(path.lastIndexOf('/') + 1);
        String answer = answers.getOrDefault(
                path,
                path.startsWith("/api/register/")
                        ? "{\"socket\": \"/socket/" + topic + "\"}"
                        : path.startsWith("/api/history/")
                                ? "{\"records\": [], \"since\": 0}"
                                : path.endsWith("/timeline")
                                        ? "{\"from\": 0, \"width\": 1, \"first\": 0, \"last\": 1, \"complete\": true, \"counts\": [1]}"
                                        : path.equals("/api/topics")
                                                ? topics()
                                                : path.startsWith("/api/density/")
                                                        ? "{\"counts\": []}"
                                                        : path.equals("/api/me")
                                                                ? "{\"user\": \"demo\", \"role\": \"admin\"}"
                                                                : "[]");
        if (answer.matches("\\d{3}.*")) {
            String reason = answer.length() > 3 ? answer.substring(4) : "the stub rejects it";
            Matcher coded = CODED.matcher(reason);
            String problem = coded.matches()
                    ? "{\"error\": \"%s\", \"reason\": \"%s\"}".formatted(coded.group(1), coded.group(2))
                    : "{\"reason\": \"" + reason + "\"}";
            route.fulfill(new Route.FulfillOptions()
                    .setStatus(Integer.parseInt(answer.substring(0, 3)))
                    .setBody(problem));
        } else if (!answer.isEmpty()) {
            json(route, answer);
        }
    }

    /** The topics with records. */
    private String topics() {
        return Stream.concat(initial.keySet().stream(), answers.keySet().stream())
                .filter(each -> !each.startsWith("/") || each.startsWith("/api/history/"))
                .map(each -> "{\"name\": \"" + each.substring(each.lastIndexOf('/') + 1) + "\", \"written\": 1}")
                .toList()
                .toString();
    }

    private static void json(Route route, String body) {
        route.fulfill(
                new Route.FulfillOptions().setContentType("application/json").setBody(body));
    }

    /** Sends a record to the page. */
    void send(String topic, String key, String value) {
        send(topic, Map.of(key, value));
    }

    /** Sends records in one frame. @param values by key */
    void send(String topic, Map<String, String> values) {
        long now = System.currentTimeMillis();
        pages.get(pages.size() - 1).page().waitForCondition(() -> sockets.containsKey(topic));
        sockets.get(topic)
                .send("{\"records\": "
                        + values.entrySet().stream()
                                .map(each -> record("event", topic, each.getKey(), each.getValue(), now))
                                .toList()
                        + "}");
    }

    private static String record(String kind, String topic, String key, String value, long time) {
        return "{\"topic\": \"%s\", \"kind\": \"%s\", \"key\": \"%s\", \"time\": %d, \"headers\": {}, \"value\": %s}"
                .formatted(topic, kind, key, time, value);
    }

    /** The requests that change something, as {@code METHOD path body}. */
    List<String> sent() {
        return sent;
    }

    @Override
    public void close() {
        List<String> errors =
                pages.stream().flatMap(page -> page.errors().stream()).toList();
        pages.forEach(FarmPage::close);
        LifeCycle.stop(server);
        assertThat(errors).as("errors of the windows").isEmpty();
    }
}
