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
 * Runs a topology in this JVM, alone or as one of several instances, and keeps it running: a thread that loses Kafka is replaced, and
 * where a client ends for another reason a new one is started, after a pause that grows from one second to one minute.
 */
public class StreamsApplication implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StreamsApplication.class);
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(30);
    private static final Duration MIN_BACKOFF = Duration.ofSeconds(1);
    private static final Duration MAX_BACKOFF = Duration.ofMinutes(1);
    /** A client that ran for this long begins with the first pause again. */
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
    /** Whether a start is scheduled: a client may say that it failed while its start does. */
    private boolean startsLater;

    /** @param name for people, as in {@code control plane} */
    StreamsApplication(String name, Supplier<Topology> topology, Properties settings) {
        this.name = name;
        this.topology = topology;
        this.settings = settings;
        this.supervisor = Executors.newSingleThreadScheduledExecutor(DaemonThreads.named(name + " supervisor"));
    }

    /** Blocks until it has what all instances hold, and must not keep others from closing this. */
    final void startClient() {
        KafkaStreams fresh = newClient();
        if (fresh != null) {
            fresh.start();
        }
    }

    /** Null once this is closed. */
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

    /** Not on a thread of the client, which its close waits for. */
    private void replaceClient() {
        streams.close(CLOSE_TIMEOUT);
        startLater();
    }

    private void startLater() {
        Duration pause;
        synchronized (this) {
            if (closed || startsLater) {
                return;
            }
            startsLater = true;
            if (started.plus(STABLE).isBefore(Instant.now())) {
                backoff.reset();
            }
            pause = backoff.next();
        }
        LOG.warn("the {} restarts in {} s", name, pause.toSeconds());
        supervisor.schedule(this::startAgain, pause.toMillis(), TimeUnit.MILLISECONDS);
    }

    private void startAgain() {
        synchronized (this) {
            startsLater = false;
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
     * Kafka being unavailable is not a fault of ours, nor that a broker does not yet know of a topic that was made a moment ago; after anything
     * else the state of this client is not trusted.
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

    /** Whether it runs, and has its state, not being about to rebuild or to hand it over. */
    public final boolean isHealthy() {
        return streams.state() == KafkaStreams.State.RUNNING;
    }

    /** For a health page: {@code RUNNING}, {@code REBALANCING} and so on. */
    public final String state() {
        return streams.state().name();
    }

    /** For a health page. Its last success is the last time that all of its threads had asked Kafka for records. */
    public ComponentStatus status() {
        KafkaStreams current = streams;
        boolean up = current.state() == KafkaStreams.State.RUNNING;
        String cause = failure;
        String detail =
                up || cause == null ? current.state().name() : current.state().name() + " after " + cause;
        return new ComponentStatus(
                name, up ? ComponentStatus.State.UP : ComponentStatus.State.DOWN, lastPoll(current), detail);
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

    /** Finishes what it is at and leaves; another instance takes over at once. */
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
