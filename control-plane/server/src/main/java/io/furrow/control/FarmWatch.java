package io.furrow.control;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.streams.StreamsConfig;

import io.furrow.control.alarm.action.AlarmActions;
import io.furrow.kafka.ComponentStatus;

/**
 * Watches the farm in this JVM: health of devices, alarms, the entities of domains and missions. It is a separate
 * application, so that the load of device reports does not delay the managers. Several instances share the work as
 * those of {@link ControlPlane} do.
 */
public final class FarmWatch extends StreamsApplication {
    /** Name of the consumer group and prefix of its internal topics, from which state is rebuilt: never changed. */
    static final String APPLICATION = "furrow-farm-watch";

    /**
     * Twice the default: on a quiet farm nearly each record is a transaction, which costs more than the record, and a
     * fifth of a second is short for an alarm.
     */
    private static final Duration COMMIT_INTERVAL = Duration.ofMillis(200);

    private final AlarmActions actions;

    private FarmWatch(ControlSettings settings, WatchOptions options, Properties streams, AlarmActions actions) {
        super(
                "farm watch",
                () -> WatchTopology.of(
                        settings.requestRetention(),
                        options,
                        settings.missions().scope()),
                streams);
        this.actions = actions;
    }

    /**
     * Creates the missing topics and starts.
     *
     * @throws IOException if the topics cannot be prepared or the webhook's secret cannot be used; the message says
     *     what to do
     */
    public static FarmWatch start(ControlSettings settings, WatchOptions options) throws IOException {
        ServiceTopics.prepare(settings);
        Properties properties = settings.streams();
        properties.put(StreamsConfig.APPLICATION_ID_CONFIG, APPLICATION);
        properties.put(StreamsConfig.COMMIT_INTERVAL_MS_CONFIG, COMMIT_INTERVAL.toMillis());
        AlarmActions actions = AlarmActions.start(settings.client(), options.webhook(), options.stop());
        try {
            FarmWatch watch = new FarmWatch(settings, options, properties, actions);
            watch.startClient();
            return watch;
        } catch (RuntimeException e) {
            actions.close();
            throw e;
        }
    }

    @Override
    public ComponentStatus status() {
        return super.status().named("farmWatch");
    }

    /** Returns the status of each thread that acts on alarms, for a health page. */
    public List<ComponentStatus> workers() {
        return actions.workers();
    }

    @Override
    public void close() {
        actions.close();
        super.close();
    }
}
