package io.furrow.connect.source.journal;

import java.time.Duration;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.function.LongSupplier;

import org.apache.kafka.connect.errors.ConnectException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Polls the offset store to release records that are in Kafka, and adopts journals that other tasks left. */
public final class JournalMaintenance implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(JournalMaintenance.class);

    private static final Duration RELEASE_INTERVAL = Duration.ofSeconds(1);
    /** A worker that does not reach Kafka waits longer than this before it stops a task. */
    private static final Duration UNAVAILABLE_AFTER = Duration.ofMillis(2500);

    private static final Duration ADOPT_INTERVAL = Duration.ofSeconds(10);
    private static final Duration FIRST_ADOPTION_BESIDE_OTHERS = Duration.ofSeconds(5);
    private static final Duration STOP_TIMEOUT = Duration.ofSeconds(2);

    private final ScheduledExecutorService thread = Executors.newSingleThreadScheduledExecutor(work -> {
        Thread made = new Thread(work, "ngsi-source-journals");
        made.setDaemon(true);
        return made;
    });

    private final TaskJournals journals;
    private final LongSupplier nanoTime;
    private volatile long lastResponse;

    private JournalMaintenance(TaskJournals journals, LongSupplier nanoTime) {
        this.journals = journals;
        this.nanoTime = nanoTime;
        this.lastResponse = nanoTime.getAsLong();
    }

    /** @param beside whether there are other tasks, which first open their own journals */
    public static JournalMaintenance start(TaskJournals journals, boolean beside) {
        return start(journals, beside, System::nanoTime);
    }

    public static JournalMaintenance start(TaskJournals journals, boolean beside, LongSupplier nanoTime) {
        JournalMaintenance maintenance = new JournalMaintenance(journals, nanoTime);
        maintenance.every(RELEASE_INTERVAL, RELEASE_INTERVAL, maintenance::release);
        maintenance.every(beside ? FIRST_ADOPTION_BESIDE_OTHERS : Duration.ZERO, ADOPT_INTERVAL, journals::adopt);
        return maintenance;
    }

    private void release() {
        journals.release();
        lastResponse = nanoTime.getAsLong();
    }

    private void every(Duration first, Duration period, Runnable work) {
        thread.scheduleWithFixedDelay(() -> safely(work), first.toMillis(), period.toMillis(), TimeUnit.MILLISECONDS);
    }

    /** The executor does not repeat a task that throws. */
    private static void safely(Runnable work) {
        try {
            work.run();
        } catch (ConnectException e) {
            LOG.debug("the offset store does not answer; retrying", e);
        } catch (RuntimeException | Error e) {
            LOG.warn("maintenance of the journals failed; retrying", e);
        }
    }

    /** Whether Kafka has not answered recently. */
    public boolean isKafkaUnavailable() {
        return nanoTime.getAsLong() - lastResponse > UNAVAILABLE_AFTER.toNanos();
    }

    /** Stops the maintenance; if Kafka answers, reads the committed offsets once more. */
    @Override
    public void close() {
        if (!isKafkaUnavailable()) {
            thread.execute(() -> safely(this::release));
            thread.shutdown();
        } else {
            thread.shutdownNow();
        }
        try {
            if (!thread.awaitTermination(STOP_TIMEOUT.toMillis(), TimeUnit.MILLISECONDS)) {
                thread.shutdownNow();
                LOG.info("the offset store does not answer when the task stops; not waiting for it");
            }
        } catch (InterruptedException e) {
            thread.shutdownNow();
            Thread.currentThread().interrupt();
        }
    }
}
