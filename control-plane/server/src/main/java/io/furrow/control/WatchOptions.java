package io.furrow.control;

import java.time.Duration;

import io.furrow.control.alarm.action.StopRobots;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.control.health.HealthOptions;

/**
 * Options of the farm watch and of the actions on alarms.
 *
 * @param health when a device counts as silent
 * @param predictionHolds how long a predicted encounter stays valid without being reported again
 * @param collisionHolds how long a collision lasts after the end of its encounter; another encounter of the pair within
 *     this time extends it
 * @param webhook receiver of alarms; null for none
 * @param stop how to stop robots of a predicted encounter, which is not a safety function; null to stop none
 */
public record WatchOptions(
        HealthOptions health,
        Duration predictionHolds,
        Duration collisionHolds,
        Webhook.Settings webhook,
        StopRobots.Settings stop) {
    /** Silent after three periods; a prediction holds for a minute, a collision for another half minute; no webhook, no stops. */
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
