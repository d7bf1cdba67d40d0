package io.furrow.flink.job;

/** The delivery guarantee of a job for the records it writes when it is restarted. */
public enum Delivery {
    /** Each record at least once, immediately visible; duplicates have the same event id. */
    AT_LEAST_ONCE,
    /** Each record once for readers with {@code isolation.level=read_committed}, visible after the next checkpoint. */
    EXACTLY_ONCE
}
