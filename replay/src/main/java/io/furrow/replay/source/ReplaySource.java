package io.furrow.replay.source;

import java.util.List;

import org.apache.flink.api.connector.source.Boundedness;
import org.apache.flink.api.connector.source.Source;
import org.apache.flink.api.connector.source.SourceReader;
import org.apache.flink.api.connector.source.SourceReaderContext;
import org.apache.flink.api.connector.source.SplitEnumerator;
import org.apache.flink.api.connector.source.SplitEnumeratorContext;
import org.apache.flink.api.connector.source.SupportsSplitReassignmentOnRecovery;
import org.apache.flink.core.io.SimpleVersionedSerializer;

import io.furrow.flink.TopicRecord;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recordings;

/**
 * Plays all replays that are wanted; its records name their topics, {@code service.replays.status} among them. Replays are divided
 * among the readers anew after each restart.
 */
public final class ReplaySource
        implements Source<TopicRecord, ReplaySplit, UnassignedReplays>, SupportsSplitReassignmentOnRecovery {
    private static final long serialVersionUID = 1L;

    private final WantedReplays wanted;
    private final Recordings recordings;
    private final PageLimits limits;

    /** @param wanted where it is said which replays shall be played */
    public ReplaySource(WantedReplays wanted, Recordings recordings, PageLimits limits) {
        this.wanted = wanted;
        this.recordings = recordings;
        this.limits = limits;
    }

    @Override
    public Boundedness getBoundedness() {
        return wanted.isBounded() ? Boundedness.BOUNDED : Boundedness.CONTINUOUS_UNBOUNDED;
    }

    @Override
    public SplitEnumerator<ReplaySplit, UnassignedReplays> createEnumerator(
            SplitEnumeratorContext<ReplaySplit> context) {
        return restoreEnumerator(context, new UnassignedReplays(List.of()));
    }

    @Override
    public SplitEnumerator<ReplaySplit, UnassignedReplays> restoreEnumerator(
            SplitEnumeratorContext<ReplaySplit> context, UnassignedReplays state) {
        return new ReplayEnumerator(context, wanted, state);
    }

    @Override
    public SourceReader<TopicRecord, ReplaySplit> createReader(SourceReaderContext context) {
        return new ReplayReader(context, recordings, limits);
    }

    @Override
    public SimpleVersionedSerializer<ReplaySplit> getSplitSerializer() {
        return new ReplaySplitSerializer();
    }

    @Override
    public SimpleVersionedSerializer<UnassignedReplays> getEnumeratorCheckpointSerializer() {
        return new UnassignedReplaysSerializer();
    }
}
