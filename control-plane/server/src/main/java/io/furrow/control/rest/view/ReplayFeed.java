package io.furrow.control.rest.view;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Writes server-sent events to one client: {@code status} with the current state of a replay, {@code over} once it was
 * removed. A slow client blocks only its own thread; intermediate states of a replay are skipped, because only the
 * names of changed replays are queued.
 */
final class ReplayFeed {
    private static final byte[] HEARTBEAT = ":\n\n".getBytes(StandardCharsets.UTF_8);

    private final ReplayStatusView replays;
    /** Null for all replays. */
    private final String only;

    private final Set<String> changed = new LinkedHashSet<>();
    /** Replays that the client has received; used by its thread only. */
    private final Set<String> shown = new HashSet<>();

    private boolean allChanged = true;
    private boolean closed;

    /** Receives the events; may block while the client does not read. */
    interface Output {
        void write(byte[] event) throws IOException;
    }

    /** @param only null for all replays */
    ReplayFeed(ReplayStatusView replays, String only) {
        this.replays = replays;
        this.only = only;
    }

    /** Called when a replay has changed. */
    synchronized void changed(String replay) {
        if (only == null || only.equals(replay)) {
            changed.add(replay);
            notifyAll();
        }
    }

    /** Called when any replay may have changed. */
    synchronized void changedAll() {
        allChanged = true;
        notifyAll();
    }

    synchronized void close() {
        closed = true;
        notifyAll();
    }

    /**
     * Writes events until the feed is closed or its only replay is over.
     *
     * @param heartbeat interval after which a comment is written if nothing has changed
     */
    void write(Output output, Duration heartbeat) throws IOException, InterruptedException {
        output.write(HEARTBEAT); // signals the client that it is connected
        boolean continues = true;
        while (continues) {
            Optional<Set<String>> due = await(heartbeat);
            if (due.isEmpty()) {
                return;
            }
            if (due.get().isEmpty()) {
                output.write(HEARTBEAT);
            }
            for (String replay : due.get()) {
                continues &= show(replay, output);
            }
        }
    }

    /** Returns the replays to write, none if a heartbeat is due; empty if it is closed. */
    private synchronized Optional<Set<String>> await(Duration heartbeat) throws InterruptedException {
        long end = System.nanoTime() + heartbeat.toNanos();
        long left = heartbeat.toMillis();
        while (!closed && left > 0 && !isDue()) {
            wait(left);
            left = Duration.ofNanos(end - System.nanoTime()).toMillis();
        }
        if (closed) {
            return Optional.empty();
        }
        Set<String> due = new LinkedHashSet<>();
        if (isDue()) {
            due.addAll(changed);
            if (allChanged) {
                due.addAll(shown);
                due.addAll(only == null ? replays.names() : Set.of(only));
            }
            changed.clear();
            allChanged = false;
        }
        return Optional.of(due);
    }

    private boolean isDue() {
        return (allChanged || !changed.isEmpty()) && replays.isComplete();
    }

    /** Writes the state of a replay. Returns whether further events are possible. */
    private boolean show(String replay, Output output) throws IOException {
        Optional<ObjectNode> now = replays.find(replay);
        if (now.isPresent()) {
            shown.add(replay);
            output.write(event("status", now.get()));
            return true;
        }
        if (!shown.remove(replay) && only == null) {
            return true; // it was over before the client connected
        }
        ObjectNode last = NgsiJson.object().put("replay", replay);
        replays.status(replay).ifPresent(status -> last.set("status", status));
        output.write(event("over", last));
        return only == null;
    }

    private static byte[] event(String name, ObjectNode data) {
        String json = new String(NgsiJson.write(data), StandardCharsets.UTF_8);
        return "event: %s\ndata: %s\n\n".formatted(name, json).getBytes(StandardCharsets.UTF_8);
    }
}
