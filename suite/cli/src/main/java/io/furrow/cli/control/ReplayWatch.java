package io.furrow.cli.control;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import org.jline.terminal.Attributes;
import org.jline.terminal.Size;
import org.jline.terminal.Terminal;
import org.jline.terminal.Terminal.Signal;
import org.jline.terminal.TerminalBuilder;
import org.jline.utils.AttributedString;
import org.jline.utils.Display;
import org.jline.utils.InfoCmp.Capability;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Follows a replay: on a terminal redrawn in place and controlled by keys, until the replay is deleted; elsewhere a line per
 * second if something changed, until it reaches its end.
 */
final class ReplayWatch implements ControlOptions.Work {
    private static final long DRAW_MILLIS = 200;
    private static final long LINE_MILLIS = 1000;
    private static final int NARROWEST = 20;
    private static final long FINISH_SECONDS = 5;

    private final ControlOptions control;
    private final String path;
    private final ReplayKeys keys = new ReplayKeys();
    private volatile String failure = "";
    private String printed = "";
    private int width;

    /** @param path of the replay */
    ReplayWatch(ControlOptions control, String path) {
        this.control = control;
        this.path = path;
    }

    @Override
    public void with(ControlApi api) throws IOException {
        JsonNode first = api.get(path);
        try (ReplayEvents events = new ReplayEvents(api, path, first)) {
            events.start();
            if (System.console() == null || !control.isForPeople()) {
                print(events);
                return;
            }
            try (Terminal terminal =
                    TerminalBuilder.builder().system(true).dumb(true).build()) {
                if (terminal.getType().startsWith(Terminal.TYPE_DUMB)) {
                    print(events);
                } else {
                    steer(terminal, events, api);
                }
            }
        }
    }

    private void print(ReplayEvents events) throws IOException {
        while (!events.isOver() && !isAtEnd(events.newest()) && pause(LINE_MILLIS)) {
            line(events);
        }
        line(events);
    }

    /** Whether it is over: without a terminal nothing rewinds it. */
    private static boolean isAtEnd(JsonNode replay) {
        JsonNode status = replay.path("status");
        return status.path("state").asText().equals("ended")
                && status.path("settled").asBoolean()
                && status.path("sequence").asLong() >= replay.path("sequence").asLong();
    }

    private void line(ReplayEvents events) throws IOException {
        String lost = events.isConnected() || events.isOver() ? "" : "  (connection lost)";
        String line = control.isForPeople()
                ? ReplayScreen.line(events.newest()) + lost
                : NgsiJson.mapper().writeValueAsString(events.newest());
        if (!line.equals(printed)) {
            printed = line;
            control.out().println(line);
            control.out().flush();
        }
    }

    /** Returns false if it was interrupted. */
    static boolean pause(long millis) {
        try {
            TimeUnit.MILLISECONDS.sleep(millis);
            return true;
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return false;
        }
    }

    /** Returns when the replay is over, or a key ends the watch. */
    void steer(Terminal terminal, ReplayEvents events, ControlApi api) throws IOException {
        Attributes before = terminal.enterRawMode();
        ExecutorService requests = Executors.newSingleThreadExecutor();
        Display display = sized(terminal);
        AtomicBoolean resized = new AtomicBoolean();
        terminal.handle(Signal.WINCH, signal -> resized.set(true));
        KeyReader reader = new KeyReader(timeout -> terminal.reader().read(timeout));
        try {
            String key = "";
            while (!events.isOver()
                    && !key.equals("end")
                    && !(key.equals("q") && keys.note().isEmpty())) {
                if (!key.isEmpty()) {
                    failure = "";
                    keys.press(key, events.newest())
                            .ifPresent(request -> requests.execute(() -> send(api, steered(events.newest()), request)));
                }
                if (resized.getAndSet(false)) { // terminals differ in wrapping lines that do not fit any more
                    terminal.puts(Capability.clear_screen);
                    display = sized(terminal);
                }
                draw(display, events);
                key = reader.read(DRAW_MILLIS);
            }
            draw(display, events);
        } finally {
            finish(requests);
            terminal.setAttributes(before);
            terminal.writer().println();
            terminal.flush();
        }
    }

    /** Sends the pending requests of the last keys. */
    private static void finish(ExecutorService requests) {
        requests.shutdown();
        try {
            if (!requests.awaitTermination(FINISH_SECONDS, TimeUnit.SECONDS)) {
                requests.shutdownNow();
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    /** The path for requests: a replay of a group is controlled with its group. */
    private String steered(JsonNode replay) {
        return replay.hasNonNull("group")
                ? ReplayTarget.ofGroup(replay.path("group").asText())
                : path;
    }

    private void send(ControlApi api, String steered, ReplayKeys.Request request) {
        try {
            String to = request.path().startsWith("/") ? request.path() : steered + "/" + request.path();
            api.send("POST", to, ControlOptions.object(request.body()));
        } catch (ControlPlaneException e) {
            failure = e.getMessage();
        }
    }

    private Display sized(Terminal terminal) {
        Size size = terminal.getSize();
        width = size.getColumns() <= 0 ? 80 : Math.max(NARROWEST, size.getColumns());
        Display display = new Display(terminal, false);
        display.resize(size.getRows() <= 0 ? 24 : size.getRows(), width);
        return display;
    }

    private void draw(Display display, ReplayEvents events) {
        List<AttributedString> lines =
                ReplayScreen.block(events.newest(), notice(events), keys.isHelp(), width - 1).stream()
                        .map(AttributedString::new)
                        .collect(Collectors.toCollection(ArrayList::new));
        display.update(lines, -1); // changes the list where it scrolls
    }

    private String notice(ReplayEvents events) {
        if (keys.note().isPresent()) {
            return "marker: " + keys.note().get() + "_   (enter keeps it, escape does not)";
        } else if (!failure.isEmpty()) {
            return failure;
        } else if (!events.isConnected() && !events.isOver()) {
            return "connecting …";
        }
        return keys.message();
    }
}
