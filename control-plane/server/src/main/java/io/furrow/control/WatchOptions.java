package io.furrow.control;

import java.time.Duration;

import io.furrow.control.alarm.action.StopRobots;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.control.health.HealthOptions;

/**
 * What the farm is watched by, and what is done about alarms.
 *
 * @param health when a device counts as silent
 * @param predictionHolds how long a predicted encounter is taken for right when it is not reported again
 * @param collisionHolds how long a collision lasts after the end of its encounter, during which another one counts to it
 * @param webhook whom to report alarms; null for nobody
 * @param stop how to stop robots that are predicted to meet, which is not a safety function; null to stop none
 */
public record WatchOptions(
        HealthOptions health,
        Duration predictionHolds,
        Duration collisionHolds,
        Webhook.Settings webhook,
        StopRobots.Settings stop) {
    /** Silent after three periods; a prediction holds for a minute, a collision half a minute more; nobody is notified, nothing is stopped. */
    public static final WatchOptions DEFAULT =
            new WatchOptions(HealthOptions.DEFAULT, Duration.ofMinutes(1), Duration.ofSeconds(30), null, null);

    public WatchOptions with(HealthOptions newHealth) {
        return new WatchOptions(newHealth, predictionHolds, collisionHolds, webhook, stop);
    }

    public WatchOptions withCollisionHolds(Duration newHolds) {
        return new WatchOptions(health, predictionHolds, newHolds, webhook, stop);
    }

    public WatchOptions with(Webhook.Settings newWebhook) {
        return new WatchOptions(health, predictionHolds, collisionHolds, newWebhook, stop);
    }

    public WatchOptions with(StopRobots.Settings newStop) {
        return new WatchOptions(health, predictionHolds, collisionHolds, webhook, newStop);
    }
}
