package io.furrow.dashboard.feed;

import java.time.Duration;

/**
 * Limits of clients and streams.
 *
 * @param streams sockets and event streams of all clients
 * @param streamsOfClient sockets and event streams of one client
 * @param tickets unused tickets of one client
 * @param ticketLife time after which a ticket expires
 * @param waitingRecords that may wait for one stream; a slower stream is closed
 * @param waitingBytes likewise
 * @param valueBytes longest value in an envelope; a longer one is cut
 * @param messageBytes longest message that a socket may send
 * @param messagesPerSecond that a socket may send
 * @param primeRecords records of the initial state
 */
public record StreamLimits(
        int streams,
        int streamsOfClient,
        int tickets,
        Duration ticketLife,
        int waitingRecords,
        long waitingBytes,
        int valueBytes,
        int messageBytes,
        int messagesPerSecond,
        int primeRecords) {
    private static final int MEBI = 1024 * 1024;

    public static final StreamLimits DEFAULT =
            new StreamLimits(1_000, 250, 500, Duration.ofSeconds(30), 20_000, 8L * MEBI, MEBI, 64 * 1024, 20, 100_000);
}
