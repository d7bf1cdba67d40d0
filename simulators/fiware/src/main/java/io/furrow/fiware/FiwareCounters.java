package io.furrow.fiware;

/**
 * Counters of a stand-in since its start.
 *
 * @param measures messages that became entity updates
 * @param measuresRefused unreadable messages, those of unknown API keys and those refused by the context broker
 * @param notificationsSent answered by the receiver with any status
 * @param notificationsFailed connection refused, or no answer in 5 s
 * @param notificationsDropped because their subscription's queue was full
 * @param notificationsQueued waiting or in flight now
 */
public record FiwareCounters(
        long measures,
        long measuresRefused,
        long notificationsSent,
        long notificationsFailed,
        long notificationsDropped,
        long notificationsQueued) {}
