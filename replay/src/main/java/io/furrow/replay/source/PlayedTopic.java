package io.furrow.replay.source;

import java.io.IOException;

import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.topic.TopicEnd;
import io.furrow.replay.topic.TopicWatch;

/** Tracks the topic of a replay. Written by the threads that read pages and watch topics, read by the task's thread. */
final class PlayedTopic implements TopicWatch.Watched {
    private final RunningReplay.Reading reading;
    private final Runnable onChange;
    /** Whether the replay continues after a restart, for which it needs the end of its topic. */
    private final boolean restored;
    /** Valid once the partitions are known. */
    private volatile TopicEnd end = TopicEnd.EMPTY;
    /** 0 until they are known. */
    private volatile int partitions;

    private volatile String problem;
    private volatile boolean deleted;
    private volatile boolean idle;

    /**
     * @param state of the replay when it was assigned
     * @param onChange called by any thread after a change
     */
    PlayedTopic(PlaybackState state, RunningReplay.Reading reading, Runnable onChange) {
        this.reading = reading;
        this.onChange = onChange;
        this.restored = state.sequence() >= 0 || state.epoch() > 0;
    }

    /** Creates a missing topic, also after a restart, because a savepoint may be restored on a new cluster. */
    void prepare(String topic) throws IOException, InterruptedException {
        try {
            boolean isFirst = partitions == 0;
            int found = reading.topics().prepare(topic);
            if (isFirst) {
                end = reading.topics().end(topic);
            }
            partitions = found;
            problem = null;
            reading.watch().add(topic, this);
        } catch (IOException e) {
            problem = e.getMessage();
            throw e;
        } finally {
            onChange.run();
        }
    }

    boolean isRestored() {
        return restored;
    }

    /** Returns whether the topic may have records: of this replay before a restart, or of an earlier replay. */
    boolean hasRecords() {
        return restored || end.epoch() >= 0;
    }

    TopicEnd end() {
        return end;
    }

    int partitions() {
        return partitions;
    }

    /** Returns why the topic cannot be created or read now; null if it can or nothing was tried yet. */
    String problem() {
        return problem;
    }

    /** Returns whether the topic was deleted since the last call. */
    boolean wasDeleted() {
        boolean was = deleted;
        deleted = false;
        return was;
    }

    /** @param isIdle whether nothing is played on the topic */
    void setIdle(boolean isIdle) {
        idle = isIdle;
    }

    @Override
    public boolean isPlaying() {
        return !idle;
    }

    @Override
    public void deleted(int left) {
        partitions = left;
        deleted = true;
        onChange.run();
    }
}
