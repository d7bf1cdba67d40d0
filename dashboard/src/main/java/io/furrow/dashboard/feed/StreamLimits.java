package io.furrow.dashboard.feed;

import java.time.Duration;

/**
 * What a client may ask for.
 *
 * @param streams sockets and event streams of all clients
 * @param streamsOfClient of one address
 * @param tickets that one address has not used yet
 * @param ticketLife after which a ticket is worth nothing
 * @param waitingRecords that wait for one stream; one that is slower is closed
 * @param waitingBytes likewise
 * @param valueBytes a longer value is cut where records have an envelope
 * @param messageBytes that a socket sends
 * @param messagesPerSecond that a socket sends
 * @param primeRecords of known state, at most
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
