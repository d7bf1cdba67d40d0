package io.furrow.analytics.collision.encounter;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.position.PositionFix;

/** Two devices of a topic, in the order of {@link PositionFix#NAMING}, as a key. */
@TypeInfo(PairSerializer.class)
public final class Pair {
    private final String topic;
    private final String first;
    private final String second;

    public Pair(String topic, String first, String second) {
        this.topic = topic;
        this.first = first;
        this.second = second;
    }

    public static Pair of(PositionFix first, PositionFix second) {
        return new Pair(first.topic(), first.identity(), second.identity());
    }

    public String topic() {
        return topic;
    }

    /** Identity of the first device. */
    public String first() {
        return first;
    }

    /** Identity of the second device. */
    public String second() {
        return second;
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof Pair pair
                && first.equals(pair.first)
                && second.equals(pair.second)
                && topic.equals(pair.topic);
    }

    @Override
    public int hashCode() {
        return 31 * first.hashCode() + second.hashCode();
    }

    @Override
    public String toString() {
        return topic + '|' + first + '|' + second;
    }
}
