package io.furrow.dashboard.proxy;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.feed.TopicFeed;

/** A stream of a client, looked after while it is open. */
interface OpenStream extends TopicFeed.Stream {
    Credentials credentials();

    /** {@link System#nanoTime} when it was opened. */
    long openedAt();

    /** Sends something, so that a client that is gone shows, and nothing on the way takes the connection for idle. */
    void ping();

    /** Who the user is now, and in which role. */
    default void refresh(User user) {}

    /** The user may not have it any more. */
    void revoke(String reason);
}
