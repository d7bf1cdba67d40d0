package io.furrow.soak.source;

import java.net.URI;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicIntegerArray;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.soak.control.Http;

/** Changes entities at a context broker at a rate; each entity is changed by one thread. */
final class EntityChanges implements AutoCloseable {
    private static final int THREADS = 4;
    private static final String FILLING = "x".repeat(700);

    private final URI entities;
    private final long nanosPerChange;
    private final AtomicIntegerArray newest;
    private final List<Thread> threads = new ArrayList<>();
    private volatile boolean paused = true;
    private volatile boolean closed;

    private EntityChanges(URI contextBroker, int entityCount, int perSecond) {
        entities = URI.create(contextBroker + "/v2/entities?options=upsert");
        nanosPerChange = Duration.ofSeconds(1).toNanos() * THREADS / perSecond;
        newest = new AtomicIntegerArray(entityCount);
    }

    /** Starts paused; {@link #resume} begins. */
    static EntityChanges prepare(URI contextBroker, int entityCount, int perSecond) {
        EntityChanges changes = new EntityChanges(contextBroker, entityCount, perSecond);
        for (int i = 0; i < THREADS; i++) {
            int first = i;
            Thread thread = new Thread(() -> changes.change(first), "changes-" + i);
            thread.setDaemon(true);
            thread.start();
            changes.threads.add(thread);
        }
        return changes;
    }

    private void change(int first) {
        int entity = first;
        long next = System.nanoTime();
        while (!closed) {
            if (paused) {
                LockSupport.parkNanos(Duration.ofMillis(20).toNanos());
                next = System.nanoTime();
                continue;
            }
            LockSupport.parkNanos(next - System.nanoTime());
            next += nanosPerChange;
            synchronized (Thread.currentThread()) {
                if (!paused) {
                    post(new NumberedChange(entity, newest.get(entity) + 1));
                }
            }
            entity = entity + THREADS < newest.length() ? entity + THREADS : first;
        }
    }

    private void post(NumberedChange change) {
        ObjectNode body =
                JsonNodeFactory.instance.objectNode().put("id", change.id()).put("type", NumberedChange.TYPE);
        body.putObject("Number").put("type", "Integer").put("value", change.number());
        body.putObject("Filling").put("type", "String").put("value", FILLING);
        int status = Http.send("POST", entities, NgsiJson.write(body)).join().status();
        if (status / 100 != 2) {
            throw new IllegalStateException("the context broker answered " + status + " to " + change);
        }
        newest.set(change.entity(), change.number());
    }

    void resume() {
        paused = false;
    }

    /** Returns once no change is being sent. */
    void pause() {
        paused = true;
        for (Thread thread : threads) {
            synchronized (thread) {
                if (!thread.isAlive()) {
                    throw new IllegalStateException("a change was rejected; see the output above");
                }
            }
        }
    }

    /** The newest state of each entity; call {@link #pause} first. */
    List<NumberedChange> newest() {
        return IntStream.range(0, newest.length())
                .mapToObj(i -> new NumberedChange(i, newest.get(i)))
                .toList();
    }

    @Override
    public void close() {
        closed = true;
    }
}
