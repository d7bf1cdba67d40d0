package io.furrow.simulators.fiware;

/**
 * What a stand-in has done since its start.
 *
 * @param measures messages of devices that became entity updates
 * @param measuresRefused messages of unknown API keys, unreadable ones and ones the context broker refused
 * @param notificationsSent answered by the receiver, whatever the status
 * @param notificationsFailed connection refused, or no answer in 5 s
 * @param notificationsDropped not sent because their subscription's queue was full
 * @param notificationsQueued waiting or under way now
 */
public record FiwareCounters(
        long measures,
        long measuresRefused,
        long notificationsSent,
        long notificationsFailed,
        long notificationsDropped,
        long notificationsQueued) {}
