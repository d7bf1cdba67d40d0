package io.furrow.control;

import java.io.IOException;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.streams.StreamsConfig;

import io.furrow.control.alarm.action.AlarmActions;
import io.furrow.kafka.ComponentStatus;

/**
 * Watches the farm in this JVM: health of devices, alarms, the entities of domains and missions. It is an application of its
 * own, so that managers answer whatever devices report. Several instances share the work as those of {@link ControlPlane} do.
 */
public final class FarmWatch implements AutoCloseable {
    /** Name of the group, first part of the names of its topics, of which state is rebuilt: never changed. */
    static final String APPLICATION = "furrow-farm-watch";

    private final StreamsApplication application;
    private final AlarmActions actions;

    private FarmWatch(StreamsApplication application, AlarmActions actions) {
        this.application = application;
        this.actions = actions;
    }

    /**
     * Makes the topics that are missing and starts.
     *
     * @throws IOException if the topics cannot be prepared, or the webhook's secret not be used; the message says what to do
     */
    public static FarmWatch start(ControlSettings settings, WatchOptions options) throws IOException {
        ServiceTopics.prepare(settings);
        Properties properties = settings.streams();
        properties.put(StreamsConfig.APPLICATION_ID_CONFIG, APPLICATION);
        AlarmActions actions = AlarmActions.start(settings.client(), options.webhook(), options.stop());
        try {
            StreamsApplication application = StreamsApplication.start(
                    "farm watch",
                    () -> WatchTopology.of(
                            settings.remembered(), options, settings.missions().scope()),
                    properties);
            return new FarmWatch(application, actions);
        } catch (RuntimeException e) {
            actions.close();
            throw e;
        }
    }

    /** Whether it watches: it runs, and has its state, not being about to rebuild or to hand it over. */
    public boolean isHealthy() {
        return application.isHealthy();
    }

    /** For a health page: {@code RUNNING}, {@code REBALANCING} and so on. */
    public String state() {
        return application.state();
    }

    /** For a health page. */
    public ComponentStatus status() {
        return application.status().named("farmWatch");
    }

    /** How it is with each thread that acts on alarms, for a health page. */
    public List<ComponentStatus> workers() {
        return actions.workers();
    }

    /** Finishes what it is at and leaves; another instance takes over at once. */
    @Override
    public void close() {
        actions.close();
        application.close();
    }
}
