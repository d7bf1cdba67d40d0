package io.furrow.control.rest.view;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Collection;
import java.util.HashSet;
import java.util.Iterator;
import java.util.LinkedHashSet;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Writes server-sent events to one client: {@code reset} before all resources of a kind, {@code status} with the
 * current state of one, {@code over} once it was removed. A slow client blocks only its own thread; intermediate states
 * are skipped, because only the keys of changed resources are queued.
 */
final class ResourceFeed {
    private static final String RESET = "event: reset\ndata: {}\n";

    private final ResourceKind kind;
    /** Null for all resources of the kind. */
    private final String only;

    private final Set<String> changed = new LinkedHashSet<>();
    /** Keys that the client has received; used by its thread only, once that has started. */
    private final Set<String> shown = new HashSet<>();

    private boolean allChanged;
    private boolean closed;
    /** Number of the last change that is written or queued. */
    private long position;

    /** Receives the events; may block while the client does not read. */
    interface Output {
        void write(byte[] event) throws IOException;
    }

    /** The keys to write, with the position that the client has then. */
    private record Batch(boolean isAll, Collection<String> keys, long position) {}

    /** @param only null for all resources of the kind */
    ResourceFeed(ResourceKind kind, String only) {
        this.kind = kind;
        this.only = only;
        this.position = kind.view().position();
    }

    /**
     * Continues where the client was: writes what has changed since, or all if that is not known.
     *
     * @param since id of the last event that the client has received; null for none
     */
    synchronized void begin(String since) {
        Optional<Collection<StateView.Change>> missed = kind.view().changesSince(since);
        allChanged = missed.isEmpty();
        missed.ifPresent(changes -> changes.forEach(change -> {
            queue(change);
            shown.add(change.key()); // perhaps: if it was removed, it is over
        }));
    }

    /** Called with each change in their order. */
    synchronized void changed(StateView.Change change) {
        position = change.position();
        queue(change);
    }

    private void queue(StateView.Change change) {
        if (kind.topics().contains(change.topic()) && (only == null || only.equals(change.key()))) {
            changed.add(change.key());
            notifyAll();
        }
    }

    /** Called when any resource may have changed. */
    synchronized void changedAll() {
        allChanged = true;
        position = kind.view().position();
        notifyAll();
    }

    synchronized void close() {
        closed = true;
        notifyAll();
    }

    /**
     * Writes events until the feed is closed or its only resource is removed.
     *
     * @param heartbeat interval after which a comment is written if nothing has changed
     */
    void write(Output output, Duration heartbeat) throws IOException, InterruptedException {
        output.write(bytes(":\n\n")); // signals the client that it is connected
        boolean continues = true;
        while (continues) {
            Batch due = await(heartbeat);
            if (due == null) {
                return;
            }
            String id = "id: " + kind.view().id(due.position()) + "\n";
            if (due.isAll()) {
                output.write(bytes(RESET + "\n"));
            }
            for (Iterator<String> keys = due.keys().iterator(); keys.hasNext(); ) {
                String event = event(keys.next());
                continues &= only == null || !event.startsWith("event: over");
                if (!event.isEmpty()) {
                    output.write(bytes(event + "\n"));
                }
            }
            output.write(
                    bytes(":\n" + id + "\n")); // after the last event of the batch: before, it would claim too much
        }
    }

    /** Returns what to write, no keys if a heartbeat is due; null if it is closed. */
    private synchronized Batch await(Duration heartbeat) throws InterruptedException {
        long end = System.nanoTime() + heartbeat.toNanos();
        long left = heartbeat.toMillis();
        while (!closed && left > 0 && !isDue()) {
            wait(left);
            left = Duration.ofNanos(end - System.nanoTime()).toMillis();
        }
        if (closed) {
            return null;
        }
        boolean isAll = allChanged && isDue();
        Set<String> due = new LinkedHashSet<>();
        if (isDue()) {
            due.addAll(changed);
            if (isAll) {
                due.addAll(shown);
                due.addAll(only == null ? kind.keys().toList() : Set.of(only));
            }
            changed.clear();
            allChanged = false;
        }
        return new Batch(isAll, due, position);
    }

    private boolean isDue() {
        return (allChanged || !changed.isEmpty()) && kind.view().isComplete();
    }

    /** Returns the event of a resource; empty if it was removed and the client has not received it. */
    private String event(String key) {
        Optional<ObjectNode> now = kind.find(key);
        if (now.isPresent()) {
            shown.add(key);
            return event("status", now.get());
        }
        return shown.remove(key) || only != null ? event("over", kind.identity().apply(key)) : "";
    }

    private static String event(String name, ObjectNode data) {
        return "event: %s\ndata: %s\n".formatted(name, new String(NgsiJson.write(data), StandardCharsets.UTF_8));
    }

    private static byte[] bytes(String text) {
        return text.getBytes(StandardCharsets.UTF_8);
    }
}
