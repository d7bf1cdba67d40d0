package io.furrow.ingest.mission;

import java.util.Map;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.ExtensionContext.Namespace;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.testcontainers.DockerClientFactory;
import org.testcontainers.containers.GenericContainer;
import org.testcontainers.containers.wait.strategy.Wait;

import io.furrow.containers.PinnedService;

import static org.junit.jupiter.api.Assumptions.abort;

/** Documents, indexes and retention of missions in MongoDB, in the image of {@code docker/compose.yaml} and with a password. */
@Tag("containers")
class RealMongoIT extends AnyMongoTest {
    private static final String NO_ENGINE =
            "there is no container engine; missions were not stored in a MongoDB, nor read from it";
    private static final int PORT = 27017;

    @RegisterExtension
    static final BeforeAllCallback IN_A_CONTAINER = context -> {
        if (!DockerClientFactory.instance().isDockerAvailable()) {
            System.out.println("RealMongoIT was NOT RUN: " + NO_ENGINE);
            abort(NO_ENGINE);
        }
        // Its first server makes the user, and ends.
        GenericContainer<?> mongo = new GenericContainer<>(
                        PinnedService.of("mongo").image())
                .withEnv(Map.of("MONGO_INITDB_ROOT_USERNAME", "furrow", "MONGO_INITDB_ROOT_PASSWORD", "harrow"))
                .withExposedPorts(PORT)
                .waitingFor(Wait.forLogMessage(".*Waiting for connections.*", 2));
        context.getStore(Namespace.GLOBAL).put(RealMongoIT.class, mongo);
        mongo.start();
        System.setProperty(
                "furrow.test.mongo",
                "mongodb://furrow:harrow@%s:%d/?authSource=admin"
                        .formatted(mongo.getHost(), mongo.getMappedPort(PORT)));
    };
}
