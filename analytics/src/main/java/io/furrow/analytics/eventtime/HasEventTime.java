package io.furrow.analytics.eventtime;

/** What happened at an instant of event time. */
public interface HasEventTime {
    /** Epoch milliseconds. */
    long time();
}
