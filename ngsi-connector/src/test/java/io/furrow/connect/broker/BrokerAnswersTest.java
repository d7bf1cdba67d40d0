package io.furrow.connect.broker;

import java.time.Duration;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.event.FiwareScope;
import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;

class BrokerAnswersTest {
    /** Answers of Orion, Orion-LD and Scorpio of several versions, and Stellio. */
    @ParameterizedTest
    @ValueSource(
            strings = {
                "{'error': 'NotFound', 'description': 'The requested entity has not been found. Check type and id'}",
                "{'error': 'NonExistingTenant', 'description': 'the tenant does not exist'}",
                "{'type': 'https://uri.etsi.org/ngsi-ld/errors/ResourceNotFound', 'title': 'Entity Not Found'}",
                "{'type': 'https://uri.etsi.org/ngsi-ld/errors/NonExistingTenant', 'title': 'No such tenant'}",
                "{'type': 'http://uri.etsi.org/ngsi-ld/errors/BadRequestData', 'title': 'Entity does not exist'}",
                "{'type': 404, 'title': 'Resource not found.', 'detail': 'Resource not found.'}",
                "{'type': 'https://uri.etsi.org/ngsi-ld/errors/ResourceNotFound', 'title': 'The referred resource has"
                        + " not been found', 'status': 404, 'instance': '/ngsi-ld/v1/entities/urn:x:1'}"
            })
    void readsInTheAnswerOfAContextBrokerThatSomethingIsAbsent(String body) {
        assertThat(answered(404, body.replace('\'', '"'))).isInstanceOf(Outcome.Absent.class);
    }

    /** Whoever says so: a smaller one may pass. */
    @ParameterizedTest
    @ValueSource(ints = {413, 414, 431})
    void callsThePageAboutARequestThatIsTooLargeARefusal(int status) {
        assertThat(answered(status, "<html>too large</html>")).isInstanceOf(Outcome.Rejected.class);
    }

    private static Outcome answered(int status, String body) {
        try (StubServer server = new StubServer(exchange -> StubServer.answer(exchange, status, body))) {
            return new BrokerClient(BrokerSettings.of(server.uri("/base"), Duration.ofSeconds(5)))
                    .send(BrokerRequest.get(FiwareScope.DEFAULT, "/v2/x"));
        }
    }
}
