package io.furrow.analytics.eventtime;

/** What happened at an instant of event time. */
public interface Timed {
    /** Epoch milliseconds. */
    long time();
}
