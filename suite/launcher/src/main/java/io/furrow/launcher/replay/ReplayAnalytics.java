package io.furrow.launcher.replay;

import java.time.Duration;
import java.util.Collection;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.InterruptException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Follows the requested replays and runs their analytics jobs, on its own thread, until it is closed; jobs then continue to run. Retries
 * when a server is unavailable.
 */
public final class ReplayAnalytics implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ReplayAnalytics.class);
    private static final Duration POLL_INTERVAL = Duration.ofSeconds(1);
    private static final Duration RETRY = Duration.ofSeconds(5);
    private static final Duration STOP_TIMEOUT = Duration.ofSeconds(5);

    private final Properties client;
    private final AnalyticsExecutor executor;
    private final CountDownLatch stop = new CountDownLatch(1);
    private final Thread thread = new Thread(this::run, "replay-analytics");
    private volatile Collection<String> waiting = List.of();

    private ReplayAnalytics(Properties client, AnalyticsExecutor executor) {
        this.client = client;
        this.executor = executor;
    }

    /** @param client settings of Kafka clients, with {@code bootstrap.servers} */
    public static ReplayAnalytics start(Properties client, AnalyticsExecutor executor) {
        ReplayAnalytics analytics = new ReplayAnalytics(client, executor);
        analytics.thread.setDaemon(true);
        analytics.thread.start();
        return analytics;
    }

    /** A sentence for each replay whose jobs wait for slots. */
    public Collection<String> waiting() {
        return waiting;
    }

    private void run() {
        try {
            while (!isStopped(Duration.ZERO)) {
                try (ReplaysReader reader = new ReplaysReader(client);
                        GroupProgress progress = new GroupProgress(client)) {
                    follow(reader, new AnalyticsReconciler(executor, progress, () -> System.nanoTime() / 1_000_000));
                } catch (InterruptException e) {
                    LOG.debug("closed", e);
                    return;
                } catch (KafkaException e) {
                    LOG.warn("Replays cannot be read; next attempt in {} s", RETRY.toSeconds(), e);
                    isStopped(RETRY);
                }
            }
        } catch (InterruptedException e) {
            LOG.debug("closed", e);
        }
    }

    private void follow(ReplaysReader reader, AnalyticsReconciler reconciler) throws InterruptedException {
        boolean failed = false;
        Duration pause = Duration.ZERO;
        while (!isStopped(pause)) {
            boolean caughtUp = reader.poll(Duration.ofMillis(100));
            pause = caughtUp ? POLL_INTERVAL : Duration.ZERO;
            if (!caughtUp) {
                continue;
            }
            try {
                reconciler.reconcile(reader.desired());
                waiting = reconciler.waiting();
                failed = false;
            } catch (AnalyticsException e) {
                if (!failed) {
                    LOG.warn("Analytics jobs of replays cannot be managed; retrying", e);
                }
                failed = true;
            }
        }
    }

    private boolean isStopped(Duration after) throws InterruptedException {
        return stop.await(after.toMillis(), TimeUnit.MILLISECONDS);
    }

    @Override
    public void close() {
        stop.countDown();
        try {
            thread.join(STOP_TIMEOUT.toMillis());
            thread.interrupt();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
