package io.furrow.replay.source;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;

import org.apache.flink.api.connector.source.SplitEnumerator;
import org.apache.flink.api.connector.source.SplitEnumeratorContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.util.FlinkRuntimeException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.replay.playback.PlaybackState;

/**
 * Assigns each desired replay to the reader that has the fewest, and sends that reader its changes. Begins when all
 * readers are there and all desiredStates are known: readers report the replays that a checkpoint gave them, and whatever
 * nobody wants any more is removed.
 */
final class ReplayEnumerator implements SplitEnumerator<ReplaySplit, EnumeratorState> {
    private static final Logger LOG = LoggerFactory.getLogger(ReplayEnumerator.class);
    private static final long PAUSE_MILLIS = 1;
    private static final long RETRY_NANOS = TimeUnit.SECONDS.toNanos(1);

    private final SplitEnumeratorContext<ReplaySplit> context;
    private final DesiredReplays source;
    private final Map<String, byte[]> desired = new LinkedHashMap<>();
    private final Map<String, ReplayStatus> told = new HashMap<>();
    private final Map<String, ReplaySplit> unassigned = new LinkedHashMap<>();
    private final Map<String, Integer> readers = new HashMap<>();
    private final Counter rejected;
    private volatile DesiredReplays.Reading desiredStates;
    private boolean caughtUp;
    /** Of the reading thread. */
    private boolean isReportedRead;

    /** What one call of the reading thread found. */
    private record Found(
            List<DesiredReplays.ReportedStatus> told,
            List<DesiredReplays.ReplayUpdate> desiredStates,
            boolean caughtUp) {}

    ReplayEnumerator(SplitEnumeratorContext<ReplaySplit> context, DesiredReplays source, EnumeratorState state) {
        this.context = context;
        this.source = source;
        state.splits().forEach(split -> unassigned.put(split.replay(), split));
        Gauge<Integer> size = desired::size;
        context.metricGroup().gauge("replaysDesired", size);
        rejected = context.metricGroup().counter("rejected");
    }

    @Override
    public void start() {
        desiredStates = source.open();
        context.callAsync(this::read, this::found, 0, PAUSE_MILLIS);
    }

    /** First what was reported before, then what is wanted. */
    private Found read() throws IOException {
        try {
            if (isReportedRead) {
                return new Found(List.of(), desiredStates.poll(), desiredStates.isCaughtUp());
            }
            List<DesiredReplays.ReportedStatus> before = desiredStates.reportedStatuses();
            isReportedRead = true;
            return new Found(before, List.of(), false);
        } catch (IOException e) {
            LockSupport.parkNanos(RETRY_NANOS);
            throw e;
        }
    }

    private void found(Found found, Throwable failure) {
        if (failure instanceof IOException) {
            LOG.warn("The desired replays cannot be read now; retrying", failure);
            return;
        }
        require(failure);
        found.told().forEach(one -> told.put(one.replay(), one.status()));
        for (DesiredReplays.ReplayUpdate replayUpdate : found.desiredStates()) {
            note(replayUpdate);
        }
        boolean first = found.caughtUp() && !caughtUp;
        caughtUp |= found.caughtUp();
        if (first) {
            told.keySet().retainAll(desired.keySet());
        }
        if (first || !found.desiredStates().isEmpty()) {
            assign();
        }
    }

    private static void require(Throwable failure) {
        if (failure != null) {
            throw new FlinkRuntimeException("It cannot be read which replays are wanted", failure);
        }
    }

    private void note(DesiredReplays.ReplayUpdate replayUpdate) {
        if (replayUpdate.replay() == null
                || !ReplayCommand.REPLAY.matcher(replayUpdate.replay()).matches()) {
            LOG.warn(
                    "A record of service.replays is skipped: its key {} is not the name of a replay",
                    replayUpdate.replay());
            rejected.inc();
            return;
        }
        if (replayUpdate.desired() == null) {
            desired.remove(replayUpdate.replay());
            told.remove(replayUpdate.replay());
        } else {
            desired.put(replayUpdate.replay(), replayUpdate.desired());
        }
        Integer reader = readers.get(replayUpdate.replay());
        if (reader != null) {
            tell(reader, replayUpdate.replay());
        }
    }

    /** What is requested of it by now. */
    private void tell(int reader, String replay) {
        if (context.registeredReaders().containsKey(reader)) {
            context.sendEventToSourceReader(reader, new ReplayChangeEvent(replay, desired.get(replay)));
        }
        if (!desired.containsKey(replay)) {
            readers.remove(replay);
            told.remove(replay);
        }
    }

    private void assign() {
        if (!caughtUp || context.registeredReaders().size() < context.currentParallelism()) {
            return;
        }
        desired.forEach((replay, value) -> {
            if (!readers.containsKey(replay) && !unassigned.containsKey(replay) && !wasOver(replay, value)) {
                fresh(replay, value);
            }
        });
        List<ReplaySplit> splits = new ArrayList<>(unassigned.values());
        unassigned.clear();
        for (ReplaySplit split : splits) {
            int reader = leastBusy();
            readers.put(split.replay(), reader);
            context.assignSplit(split, reader);
            tell(reader, split.replay());
        }
        if (source.isBounded()) { // also to readers that are there again after a failure
            context.registeredReaders().keySet().forEach(context::signalNoMoreSplits);
        }
    }

    /** Whether it was reported for good that the desired state is reached: the control plane is about to forget it. */
    private boolean wasOver(String replay, byte[] value) {
        ReplayStatus status = told.get(replay);
        if (status == null || !status.state().isOver() || !status.settled()) {
            return false;
        }
        try {
            return status.sequence() >= DesiredReplay.read(replay, value).sequence();
        } catch (UnreadableException e) { // its reader will say so
            return false;
        }
    }

    /** One that no checkpoint knows; of what was reported of it before, epochs and timestamps continue. */
    private void fresh(String replay, byte[] value) {
        ReplayStatus status = told.remove(replay);
        PlaybackState state = new PlaybackState();
        if (status != null && status.progress() != null) {
            ReplayStatus.Progress progress = status.progress();
            state = new PlaybackState(progress.epoch() + 1, progress.position() + progress.offset());
        }
        unassigned.put(replay, new ReplaySplit(replay, value, state));
    }

    private int leastBusy() {
        Map<Integer, Integer> load = new HashMap<>();
        context.registeredReaders().keySet().forEach(reader -> load.put(reader, 0));
        readers.values().forEach(reader -> load.computeIfPresent(reader, (id, count) -> count + 1));
        return load.entrySet().stream()
                .min(Map.Entry.<Integer, Integer>comparingByValue().thenComparing(Map.Entry.comparingByKey()))
                .map(Map.Entry::getKey)
                .orElseThrow();
    }

    /**
     * The replays that it had are those that it reports, or come back by {@link #addSplitsBack}. Of those of a checkpoint another
     * reader may have some since, which continues with them.
     */
    @Override
    public void addReader(int reader) {
        readers.values().removeIf(other -> other == reader);
        List<ReplaySplit> reported =
                context.registeredReaders().get(reader).<ReplaySplit>getReportedSplitsOnRegistration().stream()
                        .filter(split -> !readers.containsKey(split.replay()))
                        .toList();
        addSplitsBack(reported, reader);
    }

    @Override
    public void addSplitsBack(List<ReplaySplit> splits, int reader) {
        for (ReplaySplit split : splits) {
            readers.remove(split.replay());
            unassigned.put(split.replay(), split);
        }
        assign();
    }

    @Override
    public void handleSplitRequest(int reader, String host) {
        // readers do not ask
    }

    @Override
    public EnumeratorState snapshotState(long checkpoint) {
        return new EnumeratorState(List.copyOf(unassigned.values()));
    }

    @Override
    public void close() {
        if (desiredStates != null) {
            desiredStates.close();
        }
    }
}
