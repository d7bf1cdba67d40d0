package io.furrow.analytics.collision;

/** What happened at an instant of event time. */
interface Timed {
    /** Epoch milliseconds. */
    long time();
}
