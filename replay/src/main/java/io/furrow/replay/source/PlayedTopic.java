package io.furrow.replay.source;

import java.io.IOException;

import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.topic.TopicEnd;
import io.furrow.replay.topic.TopicWatch;

/** What is known of the topic of a replay. Learned by the threads that read pages and watch topics, asked by the task's. */
final class PlayedTopic implements TopicWatch.Watched {
    private final RunningReplay.Reading reading;
    private final Runnable changed;
    /** Whether it goes on after a restart, and first has to know what its topic has. */
    private final boolean restored;
    /** Valid as soon as the partitions are known. */
    private volatile TopicEnd end = TopicEnd.EMPTY;
    /** 0 until they are known. */
    private volatile int partitions;

    private volatile String refusal;
    private volatile boolean deleted;
    private volatile boolean rests;

    /**
     * @param state of the replay when it was assigned
     * @param changed called by any thread when something else is known
     */
    PlayedTopic(PlaybackState state, RunningReplay.Reading reading, Runnable changed) {
        this.reading = reading;
        this.changed = changed;
        this.restored = state.sequence() >= 0 || state.epoch() > 0;
    }

    /** Makes the topic where it is not there, also after a restart: a savepoint goes on at a cluster that is new. */
    void prepare(String topic) throws IOException, InterruptedException {
        try {
            boolean isFirst = partitions == 0;
            int found = reading.topics().prepare(topic);
            if (isFirst) {
                end = reading.topics().end(topic);
            }
            partitions = found;
            refusal = null;
            reading.watch().add(topic, this);
        } catch (IOException e) {
            refusal = e.getMessage();
            throw e;
        } finally {
            changed.run();
        }
    }

    boolean isRestored() {
        return restored;
    }

    /** Whether it may have records already: of this replay before a restart, or of another that was played on it. */
    boolean hasRecords() {
        return restored || end.epoch() >= 0;
    }

    TopicEnd end() {
        return end;
    }

    int partitions() {
        return partitions;
    }

    /** Why it cannot be made or read now; null if it can, or nobody has tried. */
    String refusal() {
        return refusal;
    }

    /** Whether it was deleted since this was asked last. */
    boolean wasDeleted() {
        boolean was = deleted;
        deleted = false;
        return was;
    }

    /** @param nobody whether nobody plays on it */
    void setResting(boolean nobody) {
        rests = nobody;
    }

    @Override
    public boolean isPlaying() {
        return !rests;
    }

    @Override
    public void deleted(int left) {
        partitions = left;
        deleted = true;
        changed.run();
    }
}
