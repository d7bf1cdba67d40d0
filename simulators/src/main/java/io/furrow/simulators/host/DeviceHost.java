package io.furrow.simulators.host;

import java.io.IOException;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.simulators.fleet.FarmFleet;

/**
 * Runs the devices that are wanted on {@code service.devices} as a simulated fleet, and says on {@code service.devices.status} how
 * each is. It provisions none: the control plane does. All is on Kafka, so that a host that was killed goes on where it is
 * started again, and one that failed begins anew by itself. There is to be one host at a time, because each runs all.
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
     * Starts; devices come up once the topics can be read and the MQTT broker lets them in. Kafka and the broker may be away at
     * that time.
     *
     * @throws IOException if the settings of Kafka are no such; the message says which
     */
    public static DeviceHost start(HostSettings settings) throws IOException {
        try {
            DeviceHost host = new DeviceHost(settings);
            host.thread.start();
            return host;
        } catch (KafkaException e) {
            throw new IOException("the host of devices cannot use Kafka with these settings: " + e.getMessage(), e);
        }
    }

    /** Whether all that was wanted at the start has been taken up; connections may still be on their way. */
    public boolean isCaughtUp() {
        return loop.isCaughtUp();
    }

    /** Whether it goes on taking up what is wanted. */
    public boolean isAlive() {
        return thread.isAlive();
    }

    /** When it last read what is wanted; null if it has not since it began anew. */
    public Instant lastPoll() {
        return loop.lastPoll();
    }

    /** What made it begin anew or end; empty where nothing has. */
    public String lastFailure() {
        return refusal == null ? lastFailure == null ? "" : lastFailure : refusal;
    }

    /**
     * Waits until it takes up nothing any more, because it was closed.
     *
     * @throws IOException if it has ended because the farm has another secret; the message says what to do
     */
    public void await() throws InterruptedException, IOException {
        thread.join();
        if (refusal != null) {
            throw new IOException(refusal);
        }
    }

    /** The fleet at work, for figures. */
    public FarmFleet fleet() {
        return loop.fleet();
    }

    /** Stops all devices within seconds. Their statuses stay as they are: another host may go on. */
    @Override
    public void close() {
        closing.countDown();
        try {
            thread.join(CLOSE_TIMEOUT.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        loop.fleet().close(); // where it did not end in time
    }

    private void run() {
        try {
            Duration backoff = MIN_BACKOFF;
            while (!isClosing()) {
                if (!host()) {
                    backoff = loop.isCaughtUp() ? MIN_BACKOFF : backoff;
                    closing.await(backoff.toMillis(), TimeUnit.MILLISECONDS);
                    backoff = backoff.compareTo(MAX_BACKOFF.dividedBy(2)) > 0 ? MAX_BACKOFF : backoff.multipliedBy(2);
                }
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (FarmSecretCheck.AnotherSecretException e) {
            refusal = e.getMessage();
            LOG.error("the host of devices stops: {}", refusal);
        }
    }

    /** Answers whether it ended without failing. The devices of one that failed are stopped and started again. */
    private boolean host() throws InterruptedException, FarmSecretCheck.AnotherSecretException {
        try (HostLoop now = lastFailure == null ? loop : new HostLoop(settings)) {
            loop = now;
            now.run(this::isClosing);
            return true;
        } catch (RuntimeException e) { // whatever it is, the devices shall run
            lastFailure = e.toString();
            LOG.error("the host of devices failed and begins anew", e);
            return false;
        }
    }

    private boolean isClosing() {
        return closing.getCount() == 0;
    }
}
