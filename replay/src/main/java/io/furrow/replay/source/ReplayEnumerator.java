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
 * Assigns each desired replay to the reader with the fewest replays and sends that reader its changes. It begins when
 * all readers are registered and all desired states are read: readers report the replays of their checkpoint, and
 * replays that are no longer desired are removed.
 */
final class ReplayEnumerator implements SplitEnumerator<ReplaySplit, EnumeratorState> {
    private static final Logger LOG = LoggerFactory.getLogger(ReplayEnumerator.class);
    private static final long PAUSE_MILLIS = 1;
    private static final long RETRY_NANOS = TimeUnit.SECONDS.toNanos(1);

    private final SplitEnumeratorContext<ReplaySplit> context;
    private final DesiredReplays source;
    private final Map<String, byte[]> desired = new LinkedHashMap<>();
    private final Map<String, ReplayStatus> reported = new HashMap<>();
    private final Map<String, ReplaySplit> unassigned = new LinkedHashMap<>();
    private final Map<String, Integer> readers = new HashMap<>();
    private final Counter rejected;
    private volatile DesiredReplays.Reading reading;
    private boolean caughtUp;
    /** Used by the reading thread. */
    private boolean isReportedRead;

    /** The result of one call of the reading thread. */
    private record Found(
            List<DesiredReplays.ReportedStatus> reported,
            List<DesiredReplays.ReplayUpdate> updates,
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
        reading = source.open();
        context.callAsync(this::read, this::found, 0, PAUSE_MILLIS);
    }

    /** Reads the reported statuses first, then the desired states. */
    private Found read() throws IOException {
        try {
            if (isReportedRead) {
                return new Found(List.of(), reading.poll(), reading.isCaughtUp());
            }
            List<DesiredReplays.ReportedStatus> before = reading.reportedStatuses();
            isReportedRead = true;
            return new Found(before, List.of(), false);
        } catch (IOException e) {
            LockSupport.parkNanos(RETRY_NANOS);
            throw e;
        }
    }

    private void found(Found found, Throwable failure) {
        if (failure instanceof IOException) {
            LOG.warn("Cannot read service.replays, retrying", failure);
            return;
        }
        requireReadable(failure);
        found.reported().forEach(one -> reported.put(one.replay(), one.status()));
        for (DesiredReplays.ReplayUpdate replayUpdate : found.updates()) {
            applyUpdate(replayUpdate);
        }
        boolean first = found.caughtUp() && !caughtUp;
        caughtUp |= found.caughtUp();
        if (first) {
            reported.keySet().retainAll(desired.keySet());
        }
        if (first || !found.updates().isEmpty()) {
            assign();
        }
    }

    private static void requireReadable(Throwable failure) {
        if (failure != null) {
            throw new FlinkRuntimeException("cannot read service.replays", failure);
        }
    }

    private void applyUpdate(DesiredReplays.ReplayUpdate replayUpdate) {
        if (replayUpdate.replay() == null
                || !ReplayCommand.REPLAY.matcher(replayUpdate.replay()).matches()) {
            LOG.warn(
                    "Skipping a record of service.replays: its key {} is not the name of a replay",
                    replayUpdate.replay());
            rejected.inc();
            return;
        }
        if (replayUpdate.desired() == null) {
            desired.remove(replayUpdate.replay());
            reported.remove(replayUpdate.replay());
        } else {
            desired.put(replayUpdate.replay(), replayUpdate.desired());
        }
        Integer reader = readers.get(replayUpdate.replay());
        if (reader != null) {
            sendUpdate(reader, replayUpdate.replay());
        }
    }

    /** Sends the current desired state of a replay to its reader. */
    private void sendUpdate(int reader, String replay) {
        if (context.registeredReaders().containsKey(reader)) {
            context.sendEventToSourceReader(reader, new ReplayChangeEvent(replay, desired.get(replay)));
        }
        if (!desired.containsKey(replay)) {
            readers.remove(replay);
            reported.remove(replay);
        }
    }

    private void assign() {
        if (!caughtUp || context.registeredReaders().size() < context.currentParallelism()) {
            return;
        }
        desired.forEach((replay, value) -> {
            if (!readers.containsKey(replay) && !unassigned.containsKey(replay) && !isSettled(replay, value)) {
                addNew(replay, value);
            }
        });
        List<ReplaySplit> splits = new ArrayList<>(unassigned.values());
        unassigned.clear();
        for (ReplaySplit split : splits) {
            int reader = leastBusy();
            readers.put(split.replay(), reader);
            context.assignSplit(split, reader);
            sendUpdate(reader, split.replay());
        }
        if (source.isBounded()) { // also to readers that registered again after a failure
            context.registeredReaders().keySet().forEach(context::signalNoMoreSplits);
        }
    }

    /** Returns whether the replay is over and settled in this state; the control plane is about to delete it. */
    private boolean isSettled(String replay, byte[] value) {
        ReplayStatus status = reported.get(replay);
        if (status == null || !status.state().isOver() || !status.settled()) {
            return false;
        }
        try {
            return status.sequence() >= DesiredReplay.read(replay, value).sequence();
        } catch (UnreadableException e) { // its reader reports it
            return false;
        }
    }

    /** Adds a replay that no checkpoint contains; its epochs and timestamps continue from its last status. */
    private void addNew(String replay, byte[] value) {
        ReplayStatus status = reported.remove(replay);
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
     * Takes over the replays that the reader reports; its others return by {@link #addSplitsBack}. Replays of its
     * checkpoint that another reader has meanwhile stay there.
     */
    @Override
    public void addReader(int reader) {
        readers.values().removeIf(other -> other == reader);
        List<ReplaySplit> restored =
                context.registeredReaders().get(reader).<ReplaySplit>getReportedSplitsOnRegistration().stream()
                        .filter(split -> !readers.containsKey(split.replay()))
                        .toList();
        addSplitsBack(restored, reader);
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
        // readers send no requests
    }

    @Override
    public EnumeratorState snapshotState(long checkpoint) {
        return new EnumeratorState(List.copyOf(unassigned.values()));
    }

    @Override
    public void close() {
        if (reading != null) {
            reading.close();
        }
    }
}
