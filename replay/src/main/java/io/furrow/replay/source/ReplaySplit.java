package io.furrow.replay.source;

import org.apache.flink.api.connector.source.SourceSplit;

import io.furrow.replay.playback.PlaybackState;

/**
 * A replay and its state.
 *
 * @param replay its name
 * @param desired value of the record of {@code service.replays} that was applied last; not to be changed
 * @param state of its playback
 */
public record ReplaySplit(String replay, byte[] desired, PlaybackState state) implements SourceSplit {
    @Override
    public String splitId() {
        return replay;
    }
}
