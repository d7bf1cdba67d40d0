package io.furrow.replay.topic;

/**
 * The newest of what a replay's topic has.
 *
 * @param epoch the greatest one; −1 if it has none
 * @param timestamp the greatest one, epoch ms; 0 if there is none
 */
public record TopicEnd(long epoch, long timestamp) {
    public static final TopicEnd EMPTY = new TopicEnd(-1, 0);

    TopicEnd with(long otherEpoch, long otherTimestamp) {
        return new TopicEnd(Math.max(epoch, otherEpoch), Math.max(timestamp, otherTimestamp));
    }
}
