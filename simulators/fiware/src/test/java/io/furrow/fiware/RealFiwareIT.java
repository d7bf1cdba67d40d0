package io.furrow.fiware;

import java.io.IOException;
import java.net.URI;
import java.util.Map;
import java.util.stream.Stream;

import org.junit.jupiter.api.DynamicTest;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.TestFactory;
import org.testcontainers.DockerClientFactory;
import org.testcontainers.containers.GenericContainer;
import org.testcontainers.containers.Network;
import org.testcontainers.containers.wait.strategy.Wait;

import io.furrow.containers.PinnedService;
import io.furrow.fiware.RecordedExchange.Answer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.abort;

/** Orion and the IoT Agent, in the images of {@code docker/compose.yaml}, answer what was recorded. */
@Tag("containers")
class RealFiwareIT {
    private static final String NO_ENGINE =
            "there is no container engine; what Orion and the IoT Agent answer was not compared with what is recorded";
    private static final int BROKER = 1026;
    private static final int AGENT = 4041;

    @TestFactory
    Stream<DynamicTest> answerAsRecorded() throws Exception {
        if (!DockerClientFactory.instance().isDockerAvailable()) {
            System.out.println("RealFiwareIT was NOT RUN: " + NO_ENGINE);
            return Stream.of(DynamicTest.dynamicTest("not run", () -> abort(NO_ENGINE)));
        }
        try (Network network = Network.newNetwork();
                GenericContainer<?> mongo =
                        container("mongo", network).waitingFor(Wait.forLogMessage(".*Waiting for connections.*", 1));
                GenericContainer<?> orion = container("orion", network)
                        .withEnv(Map.of("ORION_MONGO_URI", "mongodb://mongo:27017", "ORION_MULTI_SERVICE", "TRUE"))
                        .withExposedPorts(BROKER)
                        .waitingFor(Wait.forHttp("/version"));
                GenericContainer<?> agent = container("iot-agent", network)
                        .withEnv(Map.of(
                                "IOTA_CB_HOST", "orion",
                                "IOTA_CB_PORT", Integer.toString(BROKER),
                                "IOTA_CB_NGSI_VERSION", "v2",
                                "IOTA_NORTH_PORT", Integer.toString(AGENT),
                                "IOTA_PROVIDER_URL", "http://iot-agent:4041",
                                "IOTA_REGISTRY_TYPE", "memory",
                                "IOTA_DEFAULT_RESOURCE", "/iot/json"))
                        .withExposedPorts(AGENT)
                        .waitingFor(Wait.forHttp("/iot/about"))) {
            mongo.start();
            orion.start();
            agent.start();
            Map<RecordedExchange, Answer> answers = new ExchangeClient(
                            at(orion, BROKER), at(agent, AGENT), URI.create("http://orion:" + BROKER))
                    .sendAll();
            return answers.entrySet().stream()
                    .map(asked -> DynamicTest.dynamicTest(
                            asked.getKey().toString(),
                            () -> assertThat(asked.getKey().differences(asked.getValue()))
                                    .as(
                                            "answered %s, recorded %s",
                                            asked.getValue(), asked.getKey().json())
                                    .isEmpty()));
        }
    }

    private static GenericContainer<?> container(String service, Network network) throws IOException {
        return new GenericContainer<>(PinnedService.of(service).image())
                .withNetwork(network)
                .withNetworkAliases(service);
    }

    private static URI at(GenericContainer<?> container, int port) {
        return URI.create("http://%s:%d".formatted(container.getHost(), container.getMappedPort(port)));
    }
}
