package io.furrow.dashboard.proxy;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.feed.TopicFeed;

/** An open stream of a client. */
interface OpenStream extends TopicFeed.Stream {
    Credentials credentials();

    /** {@link System#nanoTime} when it was opened. */
    long openedAt();

    /** Sends a ping, so that a disconnected client is detected, and no intermediary closes the connection as idle. */
    void ping();

    /** Updates the user and role. */
    default void refresh(User user) {}

    /** Closes the stream because the user lost the permission. */
    void revoke(String reason);
}
