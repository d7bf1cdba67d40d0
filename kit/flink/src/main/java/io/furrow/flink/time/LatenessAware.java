package io.furrow.flink.time;

/** A function that treats what event time has passed in another way; see {@link KeyedLatenessOperator}. */
public interface LatenessAware {
    /** Called once, before the first element. */
    void judgeBy(EventTimeProgress reached);
}
