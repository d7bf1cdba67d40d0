package io.furrow.flink.kafka;

import java.util.List;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.ExtensionContext.Namespace;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.testcontainers.DockerClientFactory;
import org.testcontainers.containers.GenericContainer;
import org.testcontainers.containers.wait.strategy.Wait;

import io.furrow.containers.PinnedService;
import io.furrow.embedded.FreePort;

import static org.junit.jupiter.api.Assumptions.abort;

/** Sources, sinks and their transactions on Kafka in the image and with the settings of {@code docker/compose.yaml}. */
@Tag("containers")
class RealKafkaIT extends KafkaConnectorsIT {
    private static final String NO_ENGINE =
            "there is no container engine; transactions were not compared with those of Kafka's image";

    @RegisterExtension
    static final BeforeAllCallback IN_A_CONTAINER = context -> {
        if (!DockerClientFactory.instance().isDockerAvailable()) {
            System.out.println("RealKafkaIT was NOT RUN: " + NO_ENGINE);
            abort(NO_ENGINE);
        }
        PinnedService service = PinnedService.of("kafka");
        int port = FreePort.orFree(0);
        GenericContainer<?> kafka = new GenericContainer<>(service.image())
                .withEnv(service.environment())
                .withEnv(
                        "KAFKA_ADVERTISED_LISTENERS",
                        service.environment().get("KAFKA_ADVERTISED_LISTENERS").replace("9094", Integer.toString(port)))
                .withEnv("KAFKA_AUTO_CREATE_TOPICS_ENABLE", "true")
                .withCreateContainerCmdModifier(command -> command.withHostName("kafka"))
                .waitingFor(Wait.forLogMessage(".*Kafka Server started.*", 1));
        kafka.setPortBindings(List.of("127.0.0.1:%d:9094".formatted(port)));
        context.getStore(Namespace.GLOBAL).put(RealKafkaIT.class, kafka);
        kafka.start();
        System.setProperty("furrow.test.kafka", "127.0.0.1:" + port);
    };
}
