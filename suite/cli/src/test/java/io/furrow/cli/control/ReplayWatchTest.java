package io.furrow.cli.control;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.PipedInputStream;
import java.io.PipedOutputStream;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.atomic.AtomicInteger;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpExchange;
import org.assertj.core.api.ThrowingConsumer;
import org.jline.terminal.Size;
import org.jline.terminal.Terminal.Signal;
import org.jline.terminal.impl.ExternalTerminal;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.cli.control.client.ControlApi;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;
import static org.junit.jupiter.api.Assertions.assertTimeoutPreemptively;

class ReplayWatchTest {
    private static final String PATH = "/api/replays/m.0a1b2c3d";
    private static final String REPLAY =
            "{\"replay\":\"m.0a1b2c3d\",\"mission\":\"m\",\"speed\":2.0,\"wanted\":\"%s\",\"status\":{\"state\":\"%s\",\"progress\":"
                    + "{\"epoch\":1,\"position\":1777600030000,\"from\":1777600000000,\"to\":1777600060000,\"lateness\":3,\"rate\":12.5,\"events\":70}}}";

    private final BlockingQueue<String> events = new LinkedBlockingQueue<>();
    private final BlockingQueue<String> requests = new LinkedBlockingQueue<>();
    private final AtomicInteger connections = new AtomicInteger();
    private final AtomicInteger left = new AtomicInteger(1_000_000);
    private final PipedOutputStream keyboard = new PipedOutputStream();
    private final ByteArrayOutputStream screen = new ByteArrayOutputStream();
    private volatile boolean eventless;

    @AutoClose
    private final StubServer control = new StubServer(this::answer);

    private void answer(HttpExchange exchange) throws IOException {
        String path = exchange.getRequestURI().getPath();
        if (left.get() == 0 || eventless && path.endsWith("/events")) {
            exchange.sendResponseHeaders(404, -1);
        } else if (path.endsWith("/events")) {
            connections.incrementAndGet();
            exchange.getResponseHeaders().add("Content-Type", "text/event-stream");
            exchange.sendResponseHeaders(200, 0);
            try {
                String event = events.take();
                while (!event.equals("lost")) {
                    exchange.getResponseBody().write(event.getBytes(UTF_8));
                    exchange.getResponseBody().flush();
                    event = events.take();
                }
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        } else {
            left.decrementAndGet();
            if (exchange.getRequestMethod().equals("POST")) {
                requests.add(path + " " + new String(exchange.getRequestBody().readAllBytes(), UTF_8));
            }
            StubServer.answer(exchange, 200, replay("running"));
        }
        exchange.close();
    }

    private static String replay(String state) {
        return REPLAY.formatted(state.equals("paused") ? "paused" : "running", state);
    }

    private static String event(String name, String data) {
        return ": a comment\nevent: %s\ndata: %s\n\n".formatted(name, data);
    }

    @Test
    void printsLinesWhereThereIsNoTerminalAndFollowsAfterALostConnection() {
        events.add(event("status", replay("running")));
        events.add("lost");
        events.add(event("status", replay("paused")));
        events.add(event("status", replay("ended")));
        events.add(event("over", replay("ended").replace("\"speed\":2.0,", "")));
        events.add("lost");
        String output = watch();

        assertThat(connections).hasValue(2);
        assertThat(output.lines().toList())
                .doesNotHaveDuplicates()
                .last()
                .isEqualTo(
                        "m.0a1b2c3d  ended  epoch 1  2026-05-01T01:47:10Z  0:00:30 / 0:01:00  12.5 events/s  late 3 ms  70 events");
    }

    @Test
    void pollsAControlPlaneThatHasNoEventsUntilTheReplayIsForgotten() {
        eventless = true;
        left.set(2);
        String output = watch();

        assertThat(left).hasValue(0);
        assertThat(output).contains("m.0a1b2c3d  running").doesNotContain("connection lost");
    }

    /** What the command prints where there is no terminal. */
    private String watch() {
        StringWriter output = new StringWriter();
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        assertThat(line.execute(
                        "replay",
                        "watch",
                        "m.0a1b2c3d",
                        "--api",
                        control.uri("").toString()))
                .isZero();
        return output.toString();
    }

    @Test
    void isSteeredByKeysAndDrawnInATerminal() throws Exception {
        inATerminal(replay("running"), terminal -> {
            type(" ");
            assertThat(requests.take()).isEqualTo(PATH + "/pause {}");
            type("\033[C");
            assertThat(requests.take()).isEqualTo(PATH + "/seek {\"to\":1777600040000}");
            type("m");
            type("hq\n");
            assertThat(requests.take())
                    .startsWith("/api/missions/m/markers ")
                    .contains("\"note\":\"hq\"", "1777600030000");
            await().until(() -> screen.toString(UTF_8).contains("0:00:30 / 0:01:00"));
            screen.reset();
            terminal.setSize(new Size(40, 20));
            terminal.raise(Signal.WINCH);
            await().until(() -> screen.toString(UTF_8).contains("0:00:30 / 0:01:00"));
            assertThat(screen.toString(UTF_8)).as("drawn on a cleared screen").contains("\033[H\033[J");
        });
    }

    @Test
    void steersTheGroupOfAReplayThatHasOne() throws Exception {
        inATerminal(replay("running").replace("\"mission\"", "\"group\":\"0a1b2c3d\",\"mission\""), terminal -> {
            type(" ");
            assertThat(requests.take()).isEqualTo("/api/replays/groups/0a1b2c3d/pause {}");
            type("\033[C");
            assertThat(requests.take()).isEqualTo("/api/replays/groups/0a1b2c3d/seek {\"to\":1777600040000}");
            type("mh\n");
            assertThat(requests.take()).as("of its own mission").startsWith("/api/missions/m/markers ");
        });
    }

    /** What happens while a replay is watched there, until q ends it. */
    private void inATerminal(String replay, ThrowingConsumer<ExternalTerminal> typing) throws Exception {
        ControlApi api = new ControlApi(control.uri(""), null);
        try (var terminal = new ExternalTerminal("test", "ansi", new PipedInputStream(keyboard), screen, UTF_8);
                ReplayEvents status = new ReplayEvents(api, PATH, read(replay))) {
            terminal.setSize(new Size(60, 20));
            status.start();
            CompletableFuture<Void> watch = CompletableFuture.runAsync(() -> {
                try {
                    new ReplayWatch(null, PATH).steer(terminal, status, api);
                } catch (IOException e) {
                    throw new UncheckedIOException(e);
                }
            });
            typing.accept(terminal);
            type("q");
            assertThat(watch).succeedsWithin(Duration.ofMinutes(1));
        }
    }

    private void type(String keys) throws IOException {
        keyboard.write(keys.getBytes(UTF_8));
        keyboard.flush();
    }

    @Test
    void printsNoMoreOfAReplayThatRestsAtItsEnd() {
        events.add(event("status", replay("running")));
        events.add(event("status", replay("ended").replace("\"ended\"", "\"ended\",\"settled\":true")));
        assertThat(assertTimeoutPreemptively(Duration.ofMinutes(1), this::watch).lines())
                .last()
                .asString()
                .startsWith("m.0a1b2c3d  ended");
    }

    @Test
    void readsKeysThatComeAsSeveralCharacters() throws Exception {
        Deque<Integer> characters = new ArrayDeque<>();
        "\033[C\033OD\033[1;2C\033\177\rx".chars().forEach(characters::add);
        KeyReader reader = new KeyReader(timeout -> characters.isEmpty() ? -1 : characters.poll());

        assertThat(List.of(reader.read(1), reader.read(1), reader.read(1)))
                .containsExactly("right", "left", "shift-right");
        assertThat(reader.read(1)).isEqualTo("escape");
        assertThat(List.of(reader.read(1), reader.read(1), reader.read(1))).containsExactly("enter", "x", "end");
    }

    @Test
    void requestsNoPlaceBeforeAReplayHasReportedWhereItIs() throws Exception {
        ReplayKeys keys = new ReplayKeys();
        JsonNode requested = read("{\"replay\":\"m.0a1b2c3d\",\"speed\":1,\"wanted\":\"running\"}");

        for (String key : List.of("left", "]", "l", "m")) {
            assertThat(keys.press(key, requested)).as(key).isEmpty();
            assertThat(keys.message()).as(key).isEqualTo("It has not said yet where it is.");
        }
        assertThat(keys.press(" ", requested)).isPresent();
    }

    @Test
    void stepsOnlyWhileItIsPaused() throws Exception {
        ReplayKeys keys = new ReplayKeys();

        assertThat(keys.press(",", json("running"))).isEmpty();
        assertThat(keys.message()).contains("Pause it first");
        assertRequest(keys.press(",", json("paused")), "step, body={count=-1}");
        assertRequest(keys.press(" ", json("paused")), "resume, body={}");
    }

    @Test
    void stepsBackFromTheEnd() throws Exception {
        ReplayKeys keys = new ReplayKeys();

        assertRequest(keys.press(",", json("ended")), "step, body={count=-1}");
        assertThat(keys.press(".", json("ended"))).isEmpty();
        assertThat(keys.message()).contains("has ended");
    }

    @Test
    void seeksWithinWhatIsPlayed() throws Exception {
        JsonNode part = part("running");

        assertRequest(new ReplayKeys().press("[", part), "seek, body={to=1777600020000}");
        assertRequest(new ReplayKeys().press("]", part), "seek, body={to=1777600039999}");
    }

    @Test
    void showsTheShareOfWhatIsPlayed() throws Exception {
        assertThat(ReplayScreen.block(part("running"), "", false, 80))
                .contains("[" + "#".repeat(30) + "·".repeat(30) + "]  50 %", "2026-05-01T01:47:10Z  0:00:10 / 0:00:20");
        assertThat(ReplayScreen.block(part("ended"), "", false, 80)).contains("[" + "#".repeat(60) + "] 100 %");
        JsonNode range = read(replay("running")
                .replace("\"mission\"", "\"range\":{\"from\":1777600030000,\"to\":1777600050000},\"mission\""));
        assertThat(ReplayScreen.block(range, "", false, 80)).contains("[" + "·".repeat(60) + "]   0 %");
    }

    /** Of the recording's minute what is from 20 s to 40 s. */
    private static JsonNode part(String state) throws Exception {
        return NgsiJson.read(replay(state)
                .replace("\"mission\"", "\"from\":1777600020000,\"to\":1777600040000,\"mission\"")
                .getBytes(UTF_8));
    }

    @Test
    void setsARangeByItsTwoEndsAndTakesItAway() throws Exception {
        ReplayKeys keys = new ReplayKeys();
        JsonNode later = read(replay("running").replace("1777600030000", "1777600045000"));

        assertThat(keys.press("l", later)).isEmpty();
        assertThat(keys.press("l", json("running")).orElseThrow().body())
                .containsAllEntriesOf(Map.of("from", 1_777_600_030_000L, "to", 1_777_600_045_000L));
        JsonNode looping =
                read(replay("running").replace("\"mission\"", "\"range\":{\"from\":1,\"to\":2},\"mission\""));
        assertRequest(keys.press("l", looping), "loop, body={}");
    }

    @Test
    void limitsSpeedsAndJumpsToTheirBounds() throws Exception {
        ReplayKeys keys = new ReplayKeys();
        JsonNode fast = read(replay("running").replace("2.0", "800"));

        assertRequest(keys.press("+", fast), "speed, body={speed=1000.0}");
        assertRequest(keys.press("-", json("running")), "speed, body={speed=1.0}");
        assertRequest(keys.press("]", json("running")), "seek, body={to=1777600060000}");
        assertRequest(new ReplayKeys().press("shift-left", json("running")), "seek, body={to=1777600000000}");
    }

    @Test
    void jumpsOnFromWhereTheLastJumpLeads() throws Exception {
        ReplayKeys keys = new ReplayKeys();
        keys.press("right", json("running"));
        assertRequest(keys.press("right", json("running")), "seek, body={to=1777600050000}");

        JsonNode told = read(replay("running").replace("1777600030000", "1777600031000"));
        assertRequest(keys.press("right", told), "seek, body={to=1777600041000}");
    }

    @Test
    void showsAllOfItWithinNarrowTerminals() throws Exception {
        assertThat(ReplayScreen.block(json("running"), "", true, 80))
                .containsExactly(
                        "m.0a1b2c3d  running  speed 2  epoch 1",
                        "[" + "#".repeat(30) + "·".repeat(30) + "]  50 %",
                        "2026-05-01T01:47:10Z  0:00:30 / 0:01:00",
                        "12.5 events/s  late 3 ms  70 events",
                        "",
                        "space pause  ←/→ 10 s  [/] 1 min  ./, step  +/- speed  l loop  m marker  q quit");
        assertThat(ReplayScreen.block(json("running"), "a notice that is long", false, 20))
                .hasSize(6)
                .allMatch(line -> line.length() <= 20);
        assertThat(ReplayScreen.block(read("{\"replay\":\"m.0a1b2c3d\"}"), "", false, 79))
                .contains("not begun", "? help");
    }

    private static JsonNode json(String state) throws Exception {
        return read(replay(state));
    }

    private static JsonNode read(String json) throws Exception {
        return NgsiJson.read(json.getBytes(UTF_8));
    }

    private static void assertRequest(Optional<?> request, String path) {
        assertThat(request).get().hasToString("Request[path=" + path + "]");
    }
}
