package io.furrow.control.manager;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.streams.processor.TaskId;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Runs periodic steps, each atomically. A failed step is logged, at most once a minute, and retried at the next
 * punctuation, while the others continue.
 */
final class Punctuations {
    private static final Logger LOG = LoggerFactory.getLogger(Punctuations.class);
    private static final long LOG_INTERVAL = Duration.ofMinutes(1).toNanos();

    private final UnitOfWork unitOfWork;
    private final TaskId task;
    private long nextLog = System.nanoTime();

    Punctuations(UnitOfWork unitOfWork, TaskId task) {
        this.unitOfWork = unitOfWork;
        this.task = task;
    }

    void run(List<Runnable> steps) {
        for (Runnable step : steps) {
            try {
                unitOfWork.call(() -> {
                    step.run();
                    return null;
                });
            } catch (RuntimeException e) { // a bug must not end the thread
                log(e);
            }
        }
    }

    private void log(RuntimeException failure) {
        if (System.nanoTime() - nextLog >= 0) {
            nextLog = System.nanoTime() + LOG_INTERVAL;
            LOG.error("a punctuation of task {} failed and changed nothing; retrying", task, failure);
        }
    }
}
