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
 * Writes server-sent events to one client: {@code status} with a replay as it is now, {@code over} once it is forgotten. Of a client that
 * reads slowly nothing waits but its own thread: which replays have changed since is remembered, not what they were meanwhile.
 */
final class ReplayFeed {
    private static final byte[] HEARTBEAT = ":\n\n".getBytes(StandardCharsets.UTF_8);

    private final ReplayStatusView replays;
    /** Null for all replays. */
    private final String only;

    private final Set<String> changed = new LinkedHashSet<>();
    /** Those that the client knows of; of its thread only. */
    private final Set<String> shown = new HashSet<>();

    private boolean anew = true;
    private boolean closed;

    /** Takes what is written; may block as long as the client does not read. */
    interface Output {
        void write(byte[] event) throws IOException;
    }

    /** @param only null for all replays */
    ReplayFeed(ReplayStatusView replays, String only) {
        this.replays = replays;
        this.only = only;
    }

    /** Something of a replay is different. */
    synchronized void changed(String replay) {
        if (only == null || only.equals(replay)) {
            changed.add(replay);
            notifyAll();
        }
    }

    /** Everything may be different. */
    synchronized void changedAll() {
        anew = true;
        notifyAll();
    }

    synchronized void close() {
        closed = true;
        notifyAll();
    }

    /**
     * Returns when it is closed, or its only replay is over.
     *
     * @param heartbeat after which something is written though nothing has changed
     */
    void write(Output output, Duration heartbeat) throws IOException, InterruptedException {
        output.write(HEARTBEAT); // the client learns that it is connected
        boolean goesOn = true;
        while (goesOn) {
            Optional<Set<String>> due = await(heartbeat);
            if (due.isEmpty()) {
                return;
            }
            if (due.get().isEmpty()) {
                output.write(HEARTBEAT);
            }
            for (String replay : due.get()) {
                goesOn &= show(replay, output);
            }
        }
    }

    /** The replays to write, none where a heartbeat is due; empty if it is closed. */
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
            if (anew) {
                due.addAll(shown);
                due.addAll(only == null ? replays.names() : Set.of(only));
            }
            changed.clear();
            anew = false;
        }
        return Optional.of(due);
    }

    private boolean isDue() {
        return (anew || !changed.isEmpty()) && replays.isComplete();
    }

    /** Returns whether more can come. */
    private boolean show(String replay, Output output) throws IOException {
        Optional<ObjectNode> now = replays.find(replay);
        if (now.isPresent()) {
            shown.add(replay);
            output.write(event("status", now.get()));
            return true;
        }
        if (!shown.remove(replay) && only == null) {
            return true; // the last of one that was over before
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
