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

class ReplayFeedTest {
    private static final Duration LONG = Duration.ofHours(1);

    private final StateView view = new StateView();
    private final ReplayStatusView replays = new ReplayStatusView(view);
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

    private ReplayFeed feed(String only) {
        ReplayFeed feed = new ReplayFeed(replays, only);
        view.listen(new StateView.Listener() {
            @Override
            public void changed(String topic, String key) {
                feed.changed(key);
            }

            @Override
            public void completed() {
                feed.changedAll();
            }
        });
        return feed;
    }

    private Thread write(ReplayFeed feed, ReplayFeed.Output output, Duration heartbeat) {
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

    @Test
    void writesAllReplaysAndThenChanges() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(feed(null), event -> events.add(text(event)), LONG);

        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).isEqualTo("event: status\ndata: {\"replay\":\"a.0a1b2c3d\"}\n\n");
        assertThat(next(events)).contains("b.0a1b2c3d");
        put(Topics.REPLAYS_STATUS, "b.0a1b2c3d", "{\"sequence\":1}");
        assertThat(next(events))
                .isEqualTo("event: status\ndata: {\"replay\":\"b.0a1b2c3d\",\"status\":{\"sequence\":1}}\n\n");
        put(Topics.REPLAYS, "b.0a1b2c3d", null);
        assertThat(next(events))
                .isEqualTo("event: over\ndata: {\"replay\":\"b.0a1b2c3d\",\"status\":{\"sequence\":1}}\n\n");
        put(Topics.REPLAYS_STATUS, "b.0a1b2c3d", null);
        put(Topics.REPLAYS, "c.0a1b2c3d", "{\"replay\":\"c.0a1b2c3d\"}");
        assertThat(next(events)).as("b is over once").contains("c.0a1b2c3d");
    }

    @Test
    void endsWithItsReplay() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        Thread thread = write(feed("a.0a1b2c3d"), event -> events.add(text(event)), LONG);
        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).contains("event: status", "a.0a1b2c3d");
        put(Topics.REPLAYS, "b.0a1b2c3d", null);
        put(Topics.REPLAYS, "a.0a1b2c3d", null);
        assertThat(next(events)).isEqualTo("event: over\ndata: {\"replay\":\"a.0a1b2c3d\"}\n\n");
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
        reads.release();
        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).contains("event: status");
        for (int i = 1; i <= 1000; i++) {
            put(Topics.REPLAYS_STATUS, "a.0a1b2c3d", "{\"sequence\":" + i + "}");
        }
        assertThat(events).isEmpty();
        reads.release(1000);
        assertThat(next(events)).contains("{\"sequence\":1000}");
        put(Topics.REPLAYS_STATUS, "a.0a1b2c3d", "{\"sequence\":1001}");
        assertThat(next(events)).contains("{\"sequence\":1001}");
    }

    @Test
    void writesAHeartbeatWithoutChanges() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        write(feed("a.0a1b2c3d"), event -> events.add(text(event)), Duration.ofMillis(20));
        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).contains("event: status");
        assertThat(next(events)).isEqualTo(":\n\n");
        assertThat(next(events)).isEqualTo(":\n\n");
    }

    @Test
    void continuesAfterTheTopicsWereReadAgain() throws Exception {
        BlockingQueue<String> events = new LinkedBlockingQueue<>();
        ReplayFeed feed = feed(null);
        Thread thread = write(feed, event -> events.add(text(event)), LONG);
        await().until(() -> events.size() == 3);
        events.clear();

        view.clear();
        feed.changed("a.0a1b2c3d");
        put(Topics.REPLAYS, "a.0a1b2c3d", "{\"replay\":\"a.0a1b2c3d\",\"sequence\":2}");
        view.complete();
        assertThat(next(events)).contains("\"sequence\":2");
        assertThat(next(events)).contains("event: over", "b.0a1b2c3d");

        feed.close();
        thread.join(60_000);
        assertThat(thread.isAlive()).isFalse();
    }
}
