package io.furrow.analytics.eventtime;

/** An event that happened at an instant of event time. */
public interface HasEventTime {
    /** Epoch milliseconds. */
    long time();
}
