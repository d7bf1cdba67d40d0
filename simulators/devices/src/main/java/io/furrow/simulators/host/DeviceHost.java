package io.furrow.simulators.host;

import java.io.IOException;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.text.FailureText;
import io.furrow.model.time.Backoff;
import io.furrow.simulators.fleet.FarmFleet;

/**
 * Runs the devices desired on {@code service.devices} as a simulated fleet, and publishes their statuses on {@code
 * service.devices.status}. Provisions none: the control plane does. All state is on Kafka, so a host continues after a
 * kill, and restarts by itself after a failure. Run one host at a time, because each runs all devices.
 */
public final class DeviceHost implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(DeviceHost.class);
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(10);
    private static final Duration MIN_BACKOFF = Duration.ofSeconds(1);
    private static final Duration MAX_BACKOFF = Duration.ofSeconds(30);

    private final HostSettings settings;
    private final CountDownLatch closing = new CountDownLatch(1);
    private final Thread thread = new Thread(this::run, "device-host");
    private volatile HostLoop loop;
    private volatile String refusal;
    private volatile String lastFailure;

    private DeviceHost(HostSettings settings) {
        this.settings = settings;
        this.loop = new HostLoop(settings);
        thread.setDaemon(true);
    }

    /**
     * Starts; devices start once the topics can be read and the MQTT broker accepts them. Kafka and the broker may be
     * unavailable at that time.
     *
     * @throws IOException if the Kafka settings are invalid; the message says which
     */
    public static DeviceHost start(HostSettings settings) throws IOException {
        try {
            DeviceHost host = new DeviceHost(settings);
            host.thread.start();
            return host;
        } catch (KafkaException e) {
            throw new IOException("the host of devices cannot use Kafka with these settings: " + FailureText.of(e), e);
        }
    }

    /** Whether all devices desired at the start were processed; connections may still be opening. */
    public boolean isCaughtUp() {
        return loop.isCaughtUp();
    }

    public boolean isAlive() {
        return thread.isAlive();
    }

    /** Time of the last poll; null if none succeeded since its last restart. */
    public Instant lastPoll() {
        return loop.lastPoll();
    }

    /** Why it restarted or ended; empty if it did not. */
    public String lastFailure() {
        return refusal == null ? lastFailure == null ? "" : lastFailure : refusal;
    }

    /**
     * Waits until it has ended, because it was closed.
     *
     * @throws IOException if it ended because the farm has another secret; the message names the remedy
     */
    public void await() throws InterruptedException, IOException {
        thread.join();
        if (refusal != null) {
            throw new IOException(refusal);
        }
    }

    public FarmFleet fleet() {
        return loop.fleet();
    }

    /** Stops all devices within seconds. Their statuses stay as they are: another host may continue. */
    @Override
    public void close() {
        closing.countDown();
        try {
            thread.join(CLOSE_TIMEOUT.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        loop.fleet().close(); // if it did not end in time
    }

    private void run() {
        try {
            Backoff backoff = new Backoff(MIN_BACKOFF, MAX_BACKOFF);
            while (!isClosing()) {
                if (!host()) {
                    if (loop.isCaughtUp()) {
                        backoff.reset();
                    }
                    closing.await(backoff.next().toMillis(), TimeUnit.MILLISECONDS);
                }
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (FarmSecretCheck.AnotherSecretException e) {
            refusal = e.getMessage();
            LOG.error("the host of devices stops: {}", refusal);
        }
    }

    /** Returns whether it ended without failure. After a failure the devices are stopped and started again. */
    private boolean host() throws InterruptedException, FarmSecretCheck.AnotherSecretException {
        try (HostLoop now = lastFailure == null ? loop : new HostLoop(settings)) {
            loop = now;
            now.run(this::isClosing);
            return true;
        } catch (RuntimeException e) { // restarted whatever the cause
            lastFailure = FailureText.of(e);
            LOG.error("the host of devices failed and restarts", e);
            return false;
        }
    }

    private boolean isClosing() {
        return closing.getCount() == 0;
    }
}
