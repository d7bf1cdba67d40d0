package io.furrow.replay.source;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.ScheduledFuture;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;

import org.apache.flink.api.connector.source.ReaderOutput;
import org.apache.flink.api.connector.source.SourceEvent;
import org.apache.flink.api.connector.source.SourceReader;
import org.apache.flink.api.connector.source.SourceReaderContext;
import org.apache.flink.core.io.InputStatus;
import org.apache.flink.runtime.execution.SuppressRestartsException;

import io.furrow.flink.record.DeadCounters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.PageLimits;

/**
 * Plays its replays, each when it is due, and rests in between: a timer or the answer of a {@link PageReader} wakes it up. Nothing in
 * the task's thread waits for a recording.
 */
final class ReplayReader implements SourceReader<TopicRecord, ReplaySplit> {
    /** Records of one replay before another one's turn. */
    private static final int TURN = 100;

    private static final Duration TOPIC_CHECKS = Duration.ofSeconds(1);

    private final RunningReplay.Reading reading;
    private final ReplayMetrics metrics;
    private final Map<String, RunningReplay> replays = new LinkedHashMap<>();
    private final AtomicBoolean wokenUp = new AtomicBoolean();
    private volatile CompletableFuture<Void> available = CompletableFuture.completedFuture(null);
    private ScheduledExecutorService timer;
    private ScheduledFuture<?> alarm;
    private boolean noMoreSplits;

    ReplayReader(
            SourceReaderContext context, RecordingSources recordings, PageLimits limits, ReplayTopics.Writing topics) {
        DeadCounters dead = new DeadCounters(context.metricGroup());
        this.reading = new RunningReplay.Reading(
                recordings, limits, topics, new TopicWatch(topics, TOPIC_CHECKS), dead, this::wakeUp);
        this.metrics = new ReplayMetrics(context.metricGroup());
    }

    /** Milliseconds of a clock that never steps. */
    private static long now() {
        return TimeUnit.NANOSECONDS.toMillis(System.nanoTime());
    }

    /** Epoch ms at a time of that clock. */
    static long wall(long time) {
        return System.currentTimeMillis() - (now() - time);
    }

    @Override
    public void start() {
        timer = Executors.newSingleThreadScheduledExecutor(task -> {
            Thread thread = new Thread(task, "replay-timer");
            thread.setDaemon(true);
            return thread;
        });
    }

    @Override
    public void addSplits(List<ReplaySplit> splits) {
        for (ReplaySplit split : splits) {
            RunningReplay replay = new RunningReplay(split, reading, now());
            replays.put(split.replay(), replay);
            metrics.add(replay);
        }
        wakeUp();
    }

    @Override
    public void handleSourceEvents(SourceEvent event) {
        if (event instanceof WantedEvent wanted && replays.containsKey(wanted.replay())) {
            replays.get(wanted.replay()).wish(wanted.wanted());
            wakeUp();
        }
    }

    @Override
    public void notifyNoMoreSplits() {
        noMoreSplits = true;
        wakeUp();
    }

    @Override
    public InputStatus pollNext(ReaderOutput<TopicRecord> output) {
        wokenUp.set(false);
        long now = now();
        long next = Long.MAX_VALUE;
        int running = 0;
        for (Iterator<RunningReplay> each = replays.values().iterator(); each.hasNext(); ) {
            RunningReplay replay = each.next();
            next = Math.min(next, replay.run(now, TURN, output::collect));
            running += replay.isRunning() ? 1 : 0;
            if (replay.isRemoved()) {
                each.remove();
                metrics.remove(replay);
                replay.close();
            }
        }
        metrics.setRunning(running);
        if (noMoreSplits && replays.values().stream().allMatch(RunningReplay::isOver)) {
            replays.values().forEach(ReplayReader::requireSuccess);
            return InputStatus.END_OF_INPUT;
        }
        return next <= now ? goOn() : rest(next);
    }

    /** Nobody reads a status of a job that ends: it fails in its replay's stead. */
    private static void requireSuccess(RunningReplay replay) {
        replay.failure().ifPresent(reason -> {
            throw new SuppressRestartsException(
                    new IllegalStateException("replay " + replay.name() + " failed: " + reason));
        });
    }

    private InputStatus goOn() {
        available.complete(null);
        return InputStatus.MORE_AVAILABLE;
    }

    private InputStatus rest(long until) {
        available = new CompletableFuture<>();
        if (alarm != null) {
            alarm.cancel(false);
            alarm = null;
        }
        if (wokenUp.get()) { // after the future was made: who wakes from now on completes it
            return goOn();
        }
        if (until != Long.MAX_VALUE) {
            alarm = timer.schedule(this::wakeUp, Math.max(1, until - now()), TimeUnit.MILLISECONDS);
        }
        return InputStatus.NOTHING_AVAILABLE;
    }

    /** From any thread. */
    private void wakeUp() {
        wokenUp.set(true);
        available.complete(null);
    }

    @Override
    public CompletableFuture<Void> isAvailable() {
        return available;
    }

    @Override
    public List<ReplaySplit> snapshotState(long checkpoint) {
        long now = now();
        List<ReplaySplit> splits = new ArrayList<>();
        replays.values().forEach(replay -> splits.add(replay.snapshot(checkpoint, now)));
        return splits;
    }

    @Override
    public void notifyCheckpointComplete(long checkpoint) {
        replays.values().forEach(replay -> replay.completed(checkpoint));
        wakeUp();
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
