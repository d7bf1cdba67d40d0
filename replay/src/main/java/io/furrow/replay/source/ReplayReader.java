package io.furrow.replay.source;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.PriorityQueue;
import java.util.Queue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ScheduledFuture;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.connector.source.ReaderOutput;
import org.apache.flink.api.connector.source.SourceEvent;
import org.apache.flink.api.connector.source.SourceReader;
import org.apache.flink.api.connector.source.SourceReaderContext;
import org.apache.flink.core.io.InputStatus;
import org.apache.flink.runtime.execution.SuppressRestartsException;

import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.kafka.DaemonThreads;
import io.furrow.mission.PageLimits;
import io.furrow.replay.recording.PageBudget;
import io.furrow.replay.recording.RecordingSources;
import io.furrow.replay.topic.ReplayTopics;
import io.furrow.replay.topic.TopicWatch;

/**
 * Plays its replays when they are due and sleeps in between, until a timer or a result of a {@link PageReader} wakes it
 * up. The task's thread never waits for a recording. Due replays take turns of about a millisecond, the longest due
 * first, so that barriers can pass.
 */
final class ReplayReader implements SourceReader<TopicRecord, ReplaySplit> {
    private static final long PASS_NANOS = TimeUnit.MILLISECONDS.toNanos(1);

    private static final Duration TOPIC_CHECKS = Duration.ofSeconds(1);

    private final ReplayClock clock;
    private final RunningReplay.Reading reading;
    private final ReplayMetrics metrics;
    private final Map<String, RunningReplay> replays = new LinkedHashMap<>();
    private final PriorityQueue<RunningReplay> byDue =
            new PriorityQueue<>(Comparator.comparingLong(RunningReplay::due));
    /** Replays that received a result or a change. */
    private final Queue<RunningReplay> toRunSoon = new ConcurrentLinkedQueue<>();

    private volatile boolean wokenUp;
    private volatile CompletableFuture<Void> available = CompletableFuture.completedFuture(null);
    private ScheduledThreadPoolExecutor timer;
    private ScheduledFuture<?> alarm;
    private boolean noMoreSplits;

    ReplayReader(
            SourceReaderContext context,
            RecordingSources recordings,
            PageLimits limits,
            ReplayTopics.Writing topics,
            ReplayClock clock) {
        this.clock = clock;
        DeadLetterCounters dead = new DeadLetterCounters(context.metricGroup());
        this.reading = new RunningReplay.Reading(
                recordings,
                new PageBudget(limits),
                topics,
                new TopicWatch(topics, TOPIC_CHECKS),
                dead,
                clock,
                this::runSoon);
        this.metrics = new ReplayMetrics(context.metricGroup());
    }

    @Override
    public void start() {
        timer = new ScheduledThreadPoolExecutor(1, DaemonThreads.named("replay-timer"));
        timer.setRemoveOnCancelPolicy(true);
    }

    @Override
    public void addSplits(List<ReplaySplit> splits) {
        for (ReplaySplit split : splits) {
            RunningReplay replay = new RunningReplay(split, reading);
            replays.put(split.replay(), replay);
            byDue.add(replay);
            metrics.add(replay);
        }
        wakeUp();
    }

    @Override
    public void handleSourceEvents(SourceEvent event) {
        if (event instanceof ReplayChangeEvent desired && replays.containsKey(desired.replay())) {
            RunningReplay replay = replays.get(desired.replay());
            replay.update(desired.desired());
            runSoon(replay);
        }
    }

    @Override
    public void notifyNoMoreSplits() {
        noMoreSplits = true;
        wakeUp();
    }

    @Override
    public InputStatus pollNext(ReaderOutput<TopicRecord> output) {
        wokenUp = false;
        for (RunningReplay replay = toRunSoon.poll(); replay != null; replay = toRunSoon.poll()) {
            if (byDue.remove(replay)) { // else it was removed meanwhile
                replay.dueNow();
                byDue.add(replay);
            }
        }
        long endNanos = clock.nanos().getAsLong() + PASS_NANOS;
        do {
            runNext(output);
        } while (isDue() && clock.nanos().getAsLong() - endNanos < 0);
        if (noMoreSplits && replays.values().stream().allMatch(RunningReplay::isOver)) {
            replays.values().forEach(ReplayReader::requireSuccess);
            return InputStatus.END_OF_INPUT;
        }
        return isDue() ? moreAvailable() : sleepUntilDue();
    }

    private boolean isDue() {
        return !byDue.isEmpty() && byDue.peek().due() <= clock.now();
    }

    private void runNext(ReaderOutput<TopicRecord> output) {
        if (!isDue()) {
            return;
        }
        RunningReplay replay = byDue.remove();
        replay.run(output::collect);
        if (replay.isRemoved()) {
            replays.remove(replay.name());
            metrics.remove(replay);
            replay.close();
        } else {
            byDue.add(replay);
        }
    }

    /** Fails the job with its replay, because a bounded job reports no status. */
    private static void requireSuccess(RunningReplay replay) {
        replay.failure().ifPresent(reason -> {
            throw new SuppressRestartsException(
                    new IllegalStateException("replay " + replay.name() + " failed: " + reason));
        });
    }

    private InputStatus moreAvailable() {
        available.complete(null);
        return InputStatus.MORE_AVAILABLE;
    }

    private InputStatus sleepUntilDue() {
        available = new CompletableFuture<>();
        if (alarm != null) {
            alarm.cancel(false);
            alarm = null;
        }
        if (wokenUp) { // after the future was set: later calls of wakeUp complete it
            return moreAvailable();
        }
        if (!byDue.isEmpty() && byDue.peek().due() != Long.MAX_VALUE) {
            alarm = timer.schedule(this::wakeUp, clock.nanosUntil(byDue.peek().due()), TimeUnit.NANOSECONDS);
        }
        return InputStatus.NOTHING_AVAILABLE;
    }

    /** Schedules a run of the replay. Thread-safe. */
    private void runSoon(RunningReplay replay) {
        toRunSoon.add(replay);
        wakeUp();
    }

    private void wakeUp() {
        wokenUp = true;
        available.complete(null);
    }

    @Override
    public CompletableFuture<Void> isAvailable() {
        return available;
    }

    @Override
    public List<ReplaySplit> snapshotState(long checkpoint) {
        List<ReplaySplit> splits = new ArrayList<>();
        replays.values().forEach(replay -> splits.add(replay.snapshot(checkpoint)));
        return splits;
    }

    @Override
    public void notifyCheckpointComplete(long checkpoint) {
        for (RunningReplay replay : replays.values()) {
            if (replay.completed(checkpoint)) {
                runSoon(replay);
            }
        }
    }

    @Override
    public void close() {
        replays.values().forEach(RunningReplay::close);
        if (timer != null) {
            timer.shutdownNow();
        }
        reading.watch().close();
        reading.topics().close();
    }
}
