package io.furrow.control;

import java.io.IOException;

/**
 * Runs the three managers in this JVM. Several instances with the same settings share the work: the managers of domains
 * and missions are one task, that of replays another. When an instance fails, another takes over its tasks.
 */
public final class ControlPlane extends StreamsApplication {
    private ControlPlane(ControlSettings settings) {
        super(
                "managers",
                () -> ControlTopology.of(settings.requestRetention(), settings.missions(), settings.replays()),
                settings.streams());
    }

    /**
     * Prepares the topics and starts; requests are answered once {@link #isHealthy()}.
     *
     * @throws IOException if the topics cannot be prepared; the message says what to do
     */
    public static ControlPlane start(ControlSettings settings) throws IOException {
        ServiceTopics.prepare(settings);
        ControlPlane plane = new ControlPlane(settings);
        plane.startClient();
        return plane;
    }
}
