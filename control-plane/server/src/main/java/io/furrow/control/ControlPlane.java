package io.furrow.control;

import java.io.IOException;

/**
 * The three managers in this JVM. Several instances of the same settings share the work: the managers of domains and of missions
 * are one task, that of replays another; what an instance had when it died another takes over.
 */
public final class ControlPlane extends StreamsApplication {
    private ControlPlane(ControlSettings settings) {
        super(
                "managers",
                () -> ControlTopology.of(settings.remembered(), settings.missions(), settings.replays()),
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
