package io.furrow.flink.time;

/** A function that handles late events separately; see {@link KeyedLatenessOperator}. */
public interface LatenessAware {
    /** Called once, before the first element. */
    void judgeBy(EventTimeProgress reached);
}
