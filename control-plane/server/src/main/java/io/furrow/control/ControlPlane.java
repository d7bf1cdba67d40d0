package io.furrow.control;

import java.io.IOException;

import io.furrow.kafka.ComponentStatus;

/**
 * The three managers in this JVM. Several instances of the same settings share the work: the managers of domains and of missions
 * are one task, that of replays another; what an instance had when it died another takes over.
 */
public final class ControlPlane implements AutoCloseable {
    private final StreamsApplication application;

    private ControlPlane(StreamsApplication application) {
        this.application = application;
    }

    /**
     * Prepares the topics and starts; requests are answered once {@link #isHealthy()}.
     *
     * @throws IOException if the topics cannot be prepared; the message says what to do
     */
    public static ControlPlane start(ControlSettings settings) throws IOException {
        ServiceTopics.prepare(settings);
        return new ControlPlane(StreamsApplication.start(
                "managers",
                () -> ControlTopology.of(settings.remembered(), settings.missions(), settings.replays()),
                settings.streams()));
    }

    /** Whether it answers requests: it runs, and has its state, not being about to rebuild or to hand it over. */
    public boolean isHealthy() {
        return application.isHealthy();
    }

    /** For a health page: {@code RUNNING}, {@code REBALANCING} and so on. */
    public String state() {
        return application.state();
    }

    /** For a health page. */
    public ComponentStatus status() {
        return application.status();
    }

    /** Finishes what it is at and leaves; another instance takes over at once. */
    @Override
    public void close() {
        application.close();
    }
}
