package io.furrow.control;

import java.time.Duration;
import java.time.Instant;
import java.util.Properties;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;

import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.streams.CloseOptions;
import org.apache.kafka.streams.CloseOptions.GroupMembershipOperation;
import org.apache.kafka.streams.KafkaStreams;
import org.apache.kafka.streams.Topology;
import org.apache.kafka.streams.errors.MissingSourceTopicException;
import org.apache.kafka.streams.errors.StreamsUncaughtExceptionHandler.StreamThreadExceptionResponse;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.DaemonThreads;
import io.furrow.model.text.FailureText;
import io.furrow.model.time.Backoff;

/**
 * Runs a topology in this JVM, alone or as one of several instances, and keeps it running: a thread that loses Kafka is
 * replaced, and a client that fails for another reason is replaced after a backoff of one second to one minute.
 */
public class StreamsApplication implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StreamsApplication.class);
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(30);
    private static final Duration MIN_BACKOFF = Duration.ofSeconds(1);
    private static final Duration MAX_BACKOFF = Duration.ofMinutes(1);
    /** The backoff is reset if the client ran for this long. */
    private static final Duration STABLE = Duration.ofMinutes(5);

    private final String name;
    private final Supplier<Topology> topology;
    private final Properties settings;
    private final ScheduledExecutorService supervisor;
    private volatile KafkaStreams streams;
    private volatile String failure;
    private Instant started;
    private final Backoff backoff = new Backoff(MIN_BACKOFF, MAX_BACKOFF);
    private boolean closed;
    /** Whether a start is scheduled; a client may report a failure and its start may fail too. */
    private boolean startScheduled;

    /** @param name human-readable, as in {@code control plane} */
    StreamsApplication(String name, Supplier<Topology> topology, Properties settings) {
        this.name = name;
        this.topology = topology;
        this.settings = settings;
        this.supervisor = Executors.newSingleThreadScheduledExecutor(DaemonThreads.named(name + " supervisor"));
    }

    /** Blocks until the global stores are restored, therefore without the lock that {@link #close} needs. */
    final void startClient() {
        KafkaStreams fresh = newClient();
        if (fresh != null) {
            fresh.start();
        }
    }

    /** Creates a client; null if this is closed. */
    private synchronized KafkaStreams newClient() {
        if (closed) {
            return null;
        }
        started = Instant.now();
        KafkaStreams fresh = new KafkaStreams(topology.get(), settings);
        fresh.setUncaughtExceptionHandler(this::onFailure);
        fresh.setStateListener((now, before) -> {
            LOG.info("{}: {} (was {})", name, now, before);
            if (now == KafkaStreams.State.RUNNING) {
                failure = null;
            } else if (now == KafkaStreams.State.ERROR) {
                supervisor.execute(this::replaceClient);
            }
        });
        streams = fresh;
        return fresh;
    }

    /** Must not run on a thread of the client, because the client's close waits for its threads. */
    private void replaceClient() {
        streams.close(CLOSE_TIMEOUT);
        scheduleStart();
    }

    private void scheduleStart() {
        Duration pause;
        synchronized (this) {
            if (closed || startScheduled) {
                return;
            }
            startScheduled = true;
            if (started.plus(STABLE).isBefore(Instant.now())) {
                backoff.reset();
            }
            pause = backoff.next();
        }
        LOG.warn("the {} restarts in {} s", name, pause.toSeconds());
        supervisor.schedule(this::restart, pause.toMillis(), TimeUnit.MILLISECONDS);
    }

    private void restart() {
        synchronized (this) {
            startScheduled = false;
        }
        try {
            startClient();
        } catch (RuntimeException e) { // for instance while no address of Kafka resolves
            failure = FailureText.of(e);
            LOG.warn("the {} did not start", name, e);
            replaceClient();
        }
    }

    /**
     * Replaces the thread if Kafka is unavailable or the broker does not list a new topic yet; after any other failure
     * the whole client is replaced, because its state may be inconsistent.
     */
    private StreamThreadExceptionResponse onFailure(Throwable cause) {
        failure = FailureText.of(cause);
        for (Throwable each = cause; each != null; each = each.getCause()) {
            if (each instanceof RetriableException || each instanceof MissingSourceTopicException) {
                LOG.warn("the {} lost Kafka or a topic and continues when it is back", name, cause);
                return StreamThreadExceptionResponse.REPLACE_THREAD;
            }
        }
        LOG.error("the {} failed and restarts; nothing is lost", name, cause);
        return StreamThreadExceptionResponse.SHUTDOWN_CLIENT;
    }

    /** Whether it is running with its state restored, outside of a rebalance. */
    public final boolean isHealthy() {
        return streams.state() == KafkaStreams.State.RUNNING;
    }

    /** Returns the state for a health page: {@code RUNNING}, {@code REBALANCING} and so on. */
    public final String state() {
        return streams.state().name();
    }

    /** Returns the status for a health page. The last success is the last time by which all threads have polled Kafka. */
    public ComponentStatus status() {
        KafkaStreams current = streams;
        boolean isUp = current.state() == KafkaStreams.State.RUNNING;
        String cause = failure;
        String detail =
                isUp || cause == null ? current.state().name() : current.state().name() + " after " + cause;
        return new ComponentStatus(
                name, isUp ? ComponentStatus.State.UP : ComponentStatus.State.DOWN, lastPoll(current), detail);
    }

    /** Null if no thread has polled yet. */
    private static Instant lastPoll(KafkaStreams streams) {
        double max = streams.metrics().entrySet().stream()
                .filter(metric -> metric.getKey().name().equals("last-poll-seconds-ago"))
                .filter(metric ->
                        metric.getKey().tags().getOrDefault("client-id", "").endsWith("-consumer")
                                && !metric.getKey().tags().get("client-id").endsWith("-restore-consumer"))
                .mapToDouble(metric -> ((Number) metric.getValue().metricValue()).doubleValue())
                .filter(seconds -> seconds >= 0)
                .max()
                .orElse(-1);
        return max < 0 ? null : Instant.now().minusMillis((long) (max * 1000));
    }

    /** Finishes the current record and leaves the group, so that another instance takes over immediately. */
    @Override
    public void close() {
        synchronized (this) {
            closed = true;
        }
        supervisor.shutdownNow();
        if (!streams.close(CloseOptions.timeout(CLOSE_TIMEOUT)
                .withGroupMembershipOperation(GroupMembershipOperation.LEAVE_GROUP))) {
            LOG.warn("the {} did not stop within {} s", name, CLOSE_TIMEOUT.toSeconds());
        }
    }
}
