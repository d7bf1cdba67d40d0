package io.furrow.launcher.suite;

import java.net.URI;

import org.junit.jupiter.api.Test;

import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;

class ConnectorsTest {
    @Test
    void reportsWhereTheContextBrokerCannotNotify() throws Exception {
        var health = new StringBuilder("{\"subscriptions\":[{\"url\":\"http://x/v2/notify\",\"failsInARow\":0}]}");
        URI page;
        try (StubServer source = new StubServer(exchange -> StubServer.answer(exchange, 200, health.toString()))) {
            page = source.uri("/health");
            Connectors connectors = new Connectors(page, page, null);
            assertThat(connectors.undelivered()).isEmpty();

            health.replace(0, health.length(), health.toString().replace(":0", ":3"));

            assertThat(connectors.undelivered())
                    .get()
                    .asString()
                    .startsWith("The context broker could not deliver its last 3 notifications to http://x/v2/notify.");
        }
        assertThat(new Connectors(page, page, null).undelivered())
                .as("of a source that starts again")
                .isEmpty();
    }
}
