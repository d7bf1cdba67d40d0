package io.furrow.analytics.collision;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/** Two devices of a topic, in the order of {@link PositionFix#NAMING}, as a key. */
@TypeInfo(PairFormat.class)
public final class Pair {
    private final String topic;
    private final String first;
    private final String second;

    Pair(String topic, String first, String second) {
        this.topic = topic;
        this.first = first;
        this.second = second;
    }

    static Pair of(PositionFix first, PositionFix second) {
        return new Pair(first.topic(), first.identity(), second.identity());
    }

    String topic() {
        return topic;
    }

    /** Identity of the one. */
    String first() {
        return first;
    }

    /** Identity of the other. */
    String second() {
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
