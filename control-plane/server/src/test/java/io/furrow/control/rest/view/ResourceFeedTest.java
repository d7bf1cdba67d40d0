package io.furrow.control.rest.view;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class ResourceFeedTest {
    private static final Duration LONG = Duration.ofHours(1);

    private final StateView view = new StateView();
    private final ResourceKind replays = ResourceKind.replays(view);
    private final List<Thread> threads = new CopyOnWriteArrayList<>();

    @BeforeEach
    void begin() {
        view.clear();
        put(Topics.REPLAYS, "a.0a1b2c3d", "{\"replay\":\"a.0a1b2c3d\"}");
        put(Topics.REPLAYS, "b.0a1b2c3d", "{\"replay\":\"b.0a1b2c3d\"}");
        view.complete();
    }

    @AfterEach
    void end() throws InterruptedException {
        for (Thread thread : threads) {
            thread.interrupt();
            thread.join();
        }
    }

    private void put(String topic, String key, String json) {
        view.put(topic, key, json == null ? null : json.getBytes(UTF_8));
    }

    private ResourceFeed feed(String only) {
        return feed(replays, only, null);
    }

    private ResourceFeed feed(ResourceKind kind, String only, String since) {
        ResourceFeed feed = new ResourceFeed(kind, only);
        view.listen(new StateView.Listener() {
            @Override
            public void changed(StateView.Change change) {
                feed.changed(change);
            }

            @Override
            public void completed() {
                feed.changedAll();
            }
        });
        feed.begin(since);
        return feed;
    }

    private Thread write(ResourceFeed feed, ResourceFeed.Output output, Duration heartbeat) {
        Thread thread = new Thread(() -> {
            try {
                feed.write(output, heartbeat);
            } catch (IOException | InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        });
        threads.add(thread);
        thread.start();
        return thread;
    }

    private static String text(byte[] bytes) {
        return new String(bytes, UTF_8);
    }

    private static String next(BlockingQueue<String> events) throws InterruptedException {
        return events.poll(1, TimeUnit.MINUTES);
    }

    /** Without comments and resets. */
    private static String nextEvent(BlockingQueue<String> events) throws InterruptedException {
        String event = next(events);
        while (event.startsWith(":") || event.startsWith("event: reset")) {
            event = next(events);
        }
        return event;
    }

    private static String nextId(BlockingQueue<String> events) throws InterruptedException {
        String event = next(events);
        while (!event.startsWith(":\nid: ")) {
            event = next(events);
        }
        return event.substring(":\nid: ".length()).strip();
    }

    @Test
    void writesAllReplaysAndThenChanges() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(feed(null), event -> events.add(text(event)), LONG);

        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).isEqualTo("event: reset\ndata: {}\n\n");
        assertThat(next(events)).isEqualTo("event: status\ndata: {\"replay\":\"a.0a1b2c3d\"}\n\n");
        assertThat(nextEvent(events)).contains("b.0a1b2c3d");
        put(Topics.REPLAYS_STATUS, "b.0a1b2c3d", "{\"sequence\":1}");
        assertThat(nextEvent(events))
                .isEqualTo("event: status\ndata: {\"replay\":\"b.0a1b2c3d\",\"status\":{\"sequence\":1}}\n\n");
        put(Topics.REPLAYS, "b.0a1b2c3d", null);
        assertThat(nextEvent(events))
                .isEqualTo("event: over\ndata: {\"replay\":\"b.0a1b2c3d\",\"status\":{\"sequence\":1}}\n\n");
        put(Topics.REPLAYS_STATUS, "b.0a1b2c3d", null);
        put(Topics.REPLAYS, "c.0a1b2c3d", "{\"replay\":\"c.0a1b2c3d\"}");
        assertThat(nextEvent(events)).as("b is over once").contains("c.0a1b2c3d");
    }

    @Test
    void endsWithItsReplay() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        Thread thread = write(feed("a.0a1b2c3d"), event -> events.add(text(event)), LONG);
        assertThat(nextEvent(events)).contains("event: status", "a.0a1b2c3d");
        put(Topics.REPLAYS, "b.0a1b2c3d", null);
        put(Topics.REPLAYS, "a.0a1b2c3d", null);
        assertThat(nextEvent(events)).isEqualTo("event: over\ndata: {\"replay\":\"a.0a1b2c3d\"}\n\n");
        thread.join(60_000);
        assertThat(thread.isAlive()).isFalse();
    }

    @Test
    void writesOnlyTheNewestStateToASlowClient() throws Exception {
        Semaphore reads = new Semaphore(0);
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(
                feed("a.0a1b2c3d"),
                event -> {
                    events.add(text(event));
                    reads.acquireUninterruptibly();
                },
                LONG);
        reads.release(2); // its connection and the reset
        assertThat(nextEvent(events)).contains("event: status");
        for (int i = 1; i <= 1000; i++) {
            put(Topics.REPLAYS_STATUS, "a.0a1b2c3d", "{\"sequence\":" + i + "}");
        }
        assertThat(events).isEmpty();
        reads.release(1000);
        assertThat(nextEvent(events)).contains("{\"sequence\":1000}");
        put(Topics.REPLAYS_STATUS, "a.0a1b2c3d", "{\"sequence\":1001}");
        assertThat(nextEvent(events)).contains("{\"sequence\":1001}");
    }

    @Test
    void writesAHeartbeatWithoutChanges() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(feed("a.0a1b2c3d"), event -> events.add(text(event)), Duration.ofMillis(20));
        assertThat(nextEvent(events)).contains("event: status");
        String id = nextId(events);
        assertThat(nextId(events)).isEqualTo(id);
        put(Topics.DOMAINS, "north", "{}");
        await().untilAsserted(() ->
                assertThat(nextId(events)).as("another topic moves it, too").isNotEqualTo(id));
    }

    @Test
    void continuesAfterTheTopicsWereReadAgain() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        ResourceFeed feed = feed(null);
        Thread thread = write(feed, event -> events.add(text(event)), LONG);
        nextId(events);

        view.clear();
        feed.changed(new StateView.Change(1, Topics.REPLAYS, "a.0a1b2c3d"));
        put(Topics.REPLAYS, "a.0a1b2c3d", "{\"replay\":\"a.0a1b2c3d\",\"sequence\":2}");
        view.complete();
        assertThat(nextEvent(events)).contains("\"sequence\":2");
        assertThat(nextEvent(events)).contains("event: over", "b.0a1b2c3d");

        feed.close();
        thread.join(60_000);
        assertThat(thread.isAlive()).isFalse();
    }

    @Test
    void continuesAfterTheLastEventOfAClient() throws Exception {
        BlockingQueue<String> first = new LinkedBlockingQueue<>();
        ResourceFeed feed = feed(null);
        Thread thread = write(feed, event -> first.add(text(event)), LONG);
        String id = nextId(first);
        feed.close();
        thread.join(60_000);
        put(Topics.MISSIONS, "m", "{\"mission\":\"m\"}");
        put(Topics.REPLAYS, "b.0a1b2c3d", null);
        put(Topics.REPLAYS, "c.0a1b2c3d", "{\"replay\":\"c.0a1b2c3d\"}");

        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(feed(replays, null, id), event -> events.add(text(event)), LONG);

        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).isEqualTo("event: over\ndata: {\"replay\":\"b.0a1b2c3d\"}\n\n");
        assertThat(next(events)).isEqualTo("event: status\ndata: {\"replay\":\"c.0a1b2c3d\"}\n\n");
        assertThat(next(events)).startsWith(":\nid: ").doesNotContain(id);
        assertThat(events).isEmpty();
    }

    /** After a restart, with what another server or nobody has said, or after more changes than are remembered. */
    @Test
    void beginsAnewWhereTheLastEventIsNotKnown() throws Exception {
        String old = view.id(view.position());
        for (int i = 0; i <= 10_000; i++) {
            put(Topics.REPLAYS_STATUS, "a.0a1b2c3d", "{\"sequence\":" + i + "}");
        }
        for (String unknown : new String[] {null, "", "x", old, "00000000-1", view.id(1_000_000)}) {
            BlockingQueue<String> events = new LinkedBlockingQueue<>();
            write(feed(replays, null, unknown), event -> events.add(text(event)), LONG);

            assertThat(next(events)).isEqualTo(":\n\n");
            assertThat(next(events)).as(unknown).isEqualTo("event: reset\ndata: {}\n\n");
        }
    }

    @Test
    void writesMissionsDevicesAndAlarmsAsTheirListsHaveThem() throws Exception {
        put(Topics.MISSIONS, "m", "{\"mission\":\"m\",\"parts\":1}");
        put(Topics.MISSIONS_STATUS, "m", "{\"state\":\"running\"}");
        put(Topics.DEVICES, "farm|/a|d|1", "{\"device\":\"d|1\"}");
        put(Topics.DEVICES_HEALTH, "farm|/a|d|1", "{\"heard\":5}");
        put(Topics.ALARMS, "silent:d", "{\"alarm\":\"silent:d\"}");

        assertThat(firstAndLast(ResourceKind.missions(view), Topics.MISSIONS, "m"))
                .containsExactly(
                        "event: status\ndata: {\"mission\":\"m\",\"status\":{\"state\":\"running\"}}\n\n",
                        "event: over\ndata: {\"mission\":\"m\"}\n\n");
        assertThat(firstAndLast(ResourceKind.devices(view), Topics.DEVICES, "farm|/a|d|1"))
                .containsExactly(
                        "event: status\ndata: {\"device\":\"d|1\",\"health\":{\"heard\":5}}\n\n",
                        "event: over\ndata: {\"device\":\"d|1\",\"service\":\"farm\",\"servicePath\":\"/a\"}\n\n");
        assertThat(firstAndLast(ResourceKind.alarms(view), Topics.ALARMS, "silent:d"))
                .containsExactly(
                        "event: status\ndata: {\"alarm\":\"silent:d\"}\n\n",
                        "event: over\ndata: {\"alarm\":\"silent:d\"}\n\n");
    }

    private List<String> firstAndLast(ResourceKind kind, String topic, String key) throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(feed(kind, null, null), event -> events.add(text(event)), LONG);
        String first = nextEvent(events);
        put(topic, key, null);
        return List.of(first, nextEvent(events));
    }
}
