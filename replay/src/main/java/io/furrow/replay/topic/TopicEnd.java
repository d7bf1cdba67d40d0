package io.furrow.replay.topic;

/**
 * The end of a replay's topic.
 *
 * @param epoch greatest epoch; −1 if there is none
 * @param timestamp greatest timestamp, epoch ms; 0 if there is none
 */
public record TopicEnd(long epoch, long timestamp) {
    public static final TopicEnd EMPTY = new TopicEnd(-1, 0);

    TopicEnd with(long otherEpoch, long otherTimestamp) {
        return new TopicEnd(Math.max(epoch, otherEpoch), Math.max(timestamp, otherTimestamp));
    }
}
