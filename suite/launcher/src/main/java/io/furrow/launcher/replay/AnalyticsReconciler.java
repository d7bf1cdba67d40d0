package io.furrow.launcher.replay;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.LongSupplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.model.text.Counts;

/**
 * Reconciles the running analytics jobs with those that replays request. A replay's jobs start together, when its topic
 * exists and all of them fit; they end when the replay is over and {@link JobEnding} allows it. A replay that is over
 * before its jobs ran still gets them. Has no state that must survive a restart: jobs are found by name, and their
 * progress by consumer group.
 */
final class AnalyticsReconciler {
    private static final Logger LOG = LoggerFactory.getLogger(AnalyticsReconciler.class);
    private static final Duration RETRY_INTERVAL = Duration.ofSeconds(20);

    private final AnalyticsExecutor executor;
    private final JobProgress.Source progress;
    private final LongSupplier millis;
    /** By topic; contains a replay until its jobs have ended. */
    private final Map<String, DesiredAnalytics> existing = new TreeMap<>();

    private final Map<String, JobEnding> endings = new HashMap<>();
    /** The time of the next attempt to start a job, by name. */
    private final Map<String, Long> nextAttempts = new HashMap<>();

    private final Set<String> done = new HashSet<>();
    private final Map<String, String> waiting = new TreeMap<>();

    /** @param millis monotonic clock, ms */
    AnalyticsReconciler(AnalyticsExecutor executor, JobProgress.Source progress, LongSupplier millis) {
        this.executor = executor;
        this.progress = progress;
        this.millis = millis;
    }

    /** @param desired all replays */
    void reconcile(Collection<DesiredAnalytics> desired) throws AnalyticsException {
        Set<String> running = executor.running();
        learn(desired, running);
        for (DesiredAnalytics replay : List.copyOf(existing.values())) {
            try {
                end(replay, running);
                start(replay, running);
            } catch (AnalyticsException e) { // of this replay's topic; others continue
                LOG.warn("Analytics jobs on {} cannot be managed now", replay.topic(), e);
            }
        }
        existing.values().removeIf(replay -> isForgotten(replay, desired, running));
        Set<String> topics = existing.keySet();
        waiting.keySet().retainAll(topics);
    }

    /** A sentence for each replay whose jobs wait for slots. */
    Collection<String> waiting() {
        return List.copyOf(waiting.values());
    }

    private void learn(Collection<DesiredAnalytics> desired, Set<String> running) {
        existing.replaceAll((topic, replay) -> replay.ended());
        for (DesiredAnalytics replay : desired) {
            if (!replay.jobs().isEmpty()) {
                existing.put(replay.topic(), replay);
            }
        }
        for (String name : running) {
            ReplayAnalyticsJob.named(name)
                    .filter(this::hasTopic)
                    .ifPresent(job -> existing.computeIfAbsent(
                            job.topic(), topic -> new DesiredAnalytics(topic, List.of(job), true)));
        }
    }

    /** A job without its topic may belong to a replay on another Kafka. */
    private boolean hasTopic(ReplayAnalyticsJob job) {
        try {
            return existing.containsKey(job.topic()) || progress.of(job) != null;
        } catch (AnalyticsException e) {
            LOG.debug("The replay of {} cannot be determined", job.name(), e);
            return false;
        }
    }

    private void end(DesiredAnalytics replay, Set<String> running) throws AnalyticsException {
        for (ReplayAnalyticsJob job : replay.jobs()) {
            String name = job.name();
            if (!replay.over()) {
                endings.remove(name);
                done.remove(name);
            } else if (running.contains(name)) {
                JobEnding ending = endings.computeIfAbsent(name, none -> new JobEnding());
                if (ending.mayEnd(progress.of(job), millis.getAsLong())) {
                    executor.cancel(name);
                    done.add(name);
                    if (ending.isCaughtUp()) {
                        LOG.info("Ended {}", name);
                    } else {
                        LOG.warn(
                                "Ended {} before it had reported that it has read all of {}: results may be missing",
                                name,
                                job.topic());
                    }
                }
            }
        }
    }

    private void start(DesiredAnalytics replay, Set<String> running) throws AnalyticsException {
        List<ReplayAnalyticsJob> missing = new ArrayList<>();
        for (ReplayAnalyticsJob job : replay.jobs()) {
            if (!running.contains(job.name()) && !done.contains(job.name()) && isNeeded(job, replay.over())) {
                missing.add(job);
            }
        }
        int free = missing.isEmpty() ? 0 : executor.free();
        if (missing.size() > free) {
            wait(replay, missing.size(), free);
            return;
        }
        waiting.remove(replay.topic());
        for (ReplayAnalyticsJob job : missing) {
            start(job);
        }
    }

    /** After the end of a replay a job is needed only until it has read everything. */
    private boolean isNeeded(ReplayAnalyticsJob job, boolean over) throws AnalyticsException {
        JobProgress now = progress.of(job);
        return now != null && !(over && now.isCaughtUp());
    }

    private void start(ReplayAnalyticsJob job) {
        long now = millis.getAsLong();
        if (now < nextAttempts.getOrDefault(job.name(), Long.MIN_VALUE)) {
            return;
        }
        nextAttempts.put(job.name(), now + RETRY_INTERVAL.toMillis());
        try {
            executor.start(job);
            LOG.info("Started {} on {}", job.name(), job.topic());
        } catch (AnalyticsException e) {
            LOG.warn("{} was not started; next attempt in {} s", job.name(), RETRY_INTERVAL.toSeconds(), e);
        }
    }

    private void wait(DesiredAnalytics replay, int missing, int free) {
        String why =
                "No analytics on %s yet: it wants %s, %d fit. It begins when others end; stop a replay that is not needed."
                        .formatted(replay.topic(), Counts.of(missing, "job"), free);
        if (waiting.put(replay.topic(), why) == null) {
            LOG.warn(why);
        }
    }

    private boolean isForgotten(DesiredAnalytics replay, Collection<DesiredAnalytics> desired, Set<String> running) {
        boolean removed = desired.stream().noneMatch(one -> one.topic().equals(replay.topic()));
        boolean idle = replay.jobs().stream()
                .allMatch(job -> done.contains(job.name()) || !running.contains(job.name()) && !isStarting(job));
        if (!removed || !idle || waiting.containsKey(replay.topic())) {
            return false;
        }
        replay.jobs().forEach(job -> {
            endings.remove(job.name());
            done.remove(job.name());
            nextAttempts.remove(job.name());
        });
        return true;
    }

    /** Whether it was started but does not run yet. */
    private boolean isStarting(ReplayAnalyticsJob job) {
        Long next = nextAttempts.get(job.name());
        return next != null && millis.getAsLong() < next;
    }
}
