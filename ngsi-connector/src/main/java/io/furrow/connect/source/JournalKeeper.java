package io.furrow.connect.source;

import java.time.Duration;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.function.LongSupplier;

import org.apache.kafka.connect.errors.ConnectException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Asks from time to time what Kafka has, so that journals shrink, and whether journals were left by other tasks. */
final class JournalKeeper implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(JournalKeeper.class);

    private static final Duration RELEASE_EVERY = Duration.ofSeconds(1);
    /** A worker that does not find Kafka waits longer before it stops a task. */
    private static final Duration AWAY_AFTER = Duration.ofMillis(2500);

    private static final Duration ADOPT_EVERY = Duration.ofSeconds(10);
    private static final Duration FIRST_ADOPTION_BESIDE_OTHERS = Duration.ofSeconds(5);
    private static final Duration STOP_WITHIN = Duration.ofSeconds(2);

    private final ScheduledExecutorService thread = Executors.newSingleThreadScheduledExecutor(work -> {
        Thread made = new Thread(work, "ngsi-source-journals");
        made.setDaemon(true);
        return made;
    });

    private final TaskJournals journals;
    private final LongSupplier nanoTime;
    private volatile long lastAnswer;

    private JournalKeeper(TaskJournals journals, LongSupplier nanoTime) {
        this.journals = journals;
        this.nanoTime = nanoTime;
        this.lastAnswer = nanoTime.getAsLong();
    }

    /** @param beside whether there are other tasks, which first take the journals that are theirs */
    static JournalKeeper start(TaskJournals journals, boolean beside) {
        return start(journals, beside, System::nanoTime);
    }

    static JournalKeeper start(TaskJournals journals, boolean beside, LongSupplier nanoTime) {
        JournalKeeper keeper = new JournalKeeper(journals, nanoTime);
        keeper.every(RELEASE_EVERY, RELEASE_EVERY, keeper::release);
        keeper.every(beside ? FIRST_ADOPTION_BESIDE_OTHERS : Duration.ZERO, ADOPT_EVERY, journals::adopt);
        return keeper;
    }

    private void release() {
        journals.release();
        lastAnswer = nanoTime.getAsLong();
    }

    private void every(Duration first, Duration period, Runnable work) {
        thread.scheduleWithFixedDelay(() -> safely(work), first.toMillis(), period.toMillis(), TimeUnit.MILLISECONDS);
    }

    /** What throws would not be run again. */
    private static void safely(Runnable work) {
        try {
            work.run();
        } catch (ConnectException e) {
            LOG.debug("the offset store does not answer; it is asked again", e);
        } catch (RuntimeException | Error e) {
            LOG.warn("looking after the journals failed; it is tried again", e);
        }
    }

    /** Whether Kafka has not answered lately. */
    boolean isKafkaAway() {
        return nanoTime.getAsLong() - lastAnswer > AWAY_AFTER.toNanos();
    }

    /** Ends; where Kafka answers, it asks once more what Kafka has. */
    @Override
    public void close() {
        if (!isKafkaAway()) {
            thread.execute(() -> safely(this::release));
            thread.shutdown();
        } else {
            thread.shutdownNow();
        }
        try {
            if (!thread.awaitTermination(STOP_WITHIN.toMillis(), TimeUnit.MILLISECONDS)) {
                thread.shutdownNow();
                LOG.info("the offset store does not answer at the end of the task, and is not waited for");
            }
        } catch (InterruptedException e) {
            thread.shutdownNow();
            Thread.currentThread().interrupt();
        }
    }
}
