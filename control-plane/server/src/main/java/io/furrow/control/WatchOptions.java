package io.furrow.control;

import java.time.Duration;

import io.furrow.control.alarm.action.StopRobots;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.control.health.HealthOptions;

/**
 * Options of the farm watch and of the actions on alarms.
 *
 * @param health when a device counts as silent
 * @param predictionValidity how long a predicted encounter stays valid without being reported again
 * @param collisionValidity how long a collision lasts after the end of its encounter; another encounter of the pair within
 *     this time extends it
 * @param webhook receiver of alarms; null for none
 * @param stop how to stop robots of a predicted encounter, which is not a safety function; null to stop none
 */
public record WatchOptions(
        HealthOptions health,
        Duration predictionValidity,
        Duration collisionValidity,
        Webhook.Settings webhook,
        StopRobots.Settings stop) {
    /** Silent after three periods; a prediction is valid for a minute, a collision for another half minute; no webhook, no stops. */
    public static final WatchOptions DEFAULT =
            new WatchOptions(HealthOptions.DEFAULT, Duration.ofMinutes(1), Duration.ofSeconds(30), null, null);

    public WatchOptions with(HealthOptions newHealth) {
        return new WatchOptions(newHealth, predictionValidity, collisionValidity, webhook, stop);
    }

    public WatchOptions withCollisionHolds(Duration newHolds) {
        return new WatchOptions(health, predictionValidity, newHolds, webhook, stop);
    }

    public WatchOptions with(Webhook.Settings newWebhook) {
        return new WatchOptions(health, predictionValidity, collisionValidity, newWebhook, stop);
    }

    public WatchOptions with(StopRobots.Settings newStop) {
        return new WatchOptions(health, predictionValidity, collisionValidity, webhook, newStop);
    }
}
