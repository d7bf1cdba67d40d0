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

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.PageLimits;
import io.furrow.replay.recording.RecordingSources;
import io.furrow.replay.topic.ReplayTopics;

/**
 * Plays all desired replays; the records name their topics, including {@code service.replays.status}. After each
 * restart the replays are distributed among the readers again.
 */
public final class ReplaySource
        implements Source<TopicRecord, ReplaySplit, EnumeratorState>, SupportsSplitReassignmentOnRecovery {
    private static final long serialVersionUID = 1L;

    private final DesiredReplays desired;
    private final RecordingSources recordings;
    private final PageLimits limits;
    private final ReplayTopics topics;

    public ReplaySource(DesiredReplays desired, RecordingSources recordings, PageLimits limits, ReplayTopics topics) {
        this.desired = desired;
        this.recordings = recordings;
        this.limits = limits;
        this.topics = topics;
    }

    @Override
    public Boundedness getBoundedness() {
        return desired.isBounded() ? Boundedness.BOUNDED : Boundedness.CONTINUOUS_UNBOUNDED;
    }

    @Override
    public SplitEnumerator<ReplaySplit, EnumeratorState> createEnumerator(SplitEnumeratorContext<ReplaySplit> context) {
        return restoreEnumerator(context, new EnumeratorState(List.of()));
    }

    @Override
    public SplitEnumerator<ReplaySplit, EnumeratorState> restoreEnumerator(
            SplitEnumeratorContext<ReplaySplit> context, EnumeratorState state) {
        return new ReplayEnumerator(context, desired, state);
    }

    @Override
    public SourceReader<TopicRecord, ReplaySplit> createReader(SourceReaderContext context) {
        return new ReplayReader(context, recordings, limits, topics.open(), ReplayClock.SYSTEM);
    }

    @Override
    public SimpleVersionedSerializer<ReplaySplit> getSplitSerializer() {
        return new ReplaySplitSerializer();
    }

    @Override
    public SimpleVersionedSerializer<EnumeratorState> getEnumeratorCheckpointSerializer() {
        return new EnumeratorStateSerializer();
    }
}
