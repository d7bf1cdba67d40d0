package io.furrow.flink.time;

/** A function that treats what event time has passed in another way; see {@link KeyedLatenessOperator}. */
public interface JudgesLateness {
    /** Called once, before the first element. */
    void judgeBy(EventTimeReached reached);
}
