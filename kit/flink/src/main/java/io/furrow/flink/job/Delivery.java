package io.furrow.flink.job;

/** What a job promises about the records it writes when it is restarted. */
public enum Delivery {
    /** Each record at least once, at once visible; repeats carry the same event id. */
    AT_LEAST_ONCE,
    /** Each record once for readers with {@code isolation.level=read_committed}, visible after the next checkpoint. */
    EXACTLY_ONCE
}
