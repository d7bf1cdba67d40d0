package io.furrow.connect.source;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Timer;
import java.util.TimerTask;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Sources without a task. A distributed worker stops its tasks when it does not find its group's coordinator for
 * {@code heartbeat.interval.ms}, and starts them again when Kafka is back; meanwhile the source goes on taking notifications,
 * which a context broker would not send again. If no task comes for it in time, it is closed and its journal is left.
 */
final class Standby {
    private static final Logger LOG = LoggerFactory.getLogger(Standby.class);
    private static final Map<String, Standby> WAITING = new HashMap<>();

    private final RunningSource source;
    private final Timer timer = new Timer("ngsi-source-standby", true);

    private Standby(RunningSource source) {
        this.source = source;
    }

    /** Lets a source run on without a task, for a time. */
    static void enter(NgsiSourceConfig config, RunningSource source) {
        Duration patience = config.journal().standby();
        Standby standby = new Standby(source);
        source.subscriptions().rest(true);
        synchronized (WAITING) {
            WAITING.put(name(config), standby);
        }
        LOG.warn(
                "Kafka is away and the worker stops the task of {}; notifications are taken for {} s more",
                name(config),
                patience.toSeconds());
        standby.timer.schedule(
                new TimerTask() {
                    @Override
                    public void run() {
                        standby.giveUp(name(config));
                    }
                },
                patience.toMillis());
    }

    /** The source that runs without its task, if its options are still the same; it is closed if they are not. */
    static Optional<RunningSource> leave(NgsiSourceConfig config) {
        Standby standby;
        synchronized (WAITING) {
            standby = WAITING.remove(name(config));
        }
        if (standby == null) {
            return Optional.empty();
        }
        standby.timer.cancel();
        if (standby.source.properties().equals(config.originalsStrings())) {
            standby.source.subscriptions().rest(false);
            return Optional.of(standby.source);
        }
        standby.source.close();
        return Optional.empty();
    }

    private void giveUp(String name) {
        synchronized (WAITING) {
            if (!WAITING.remove(name, this)) {
                return;
            }
        }
        LOG.warn("no task came for {}; its journal is left to the next", name);
        timer.cancel();
        source.close();
    }

    private static String name(NgsiSourceConfig config) {
        return config.name() + " " + config.taskIndex();
    }
}
