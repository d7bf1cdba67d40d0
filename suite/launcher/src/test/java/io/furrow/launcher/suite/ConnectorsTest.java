package io.furrow.launcher.suite;

import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.URI;

import com.sun.net.httpserver.HttpServer;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ConnectorsTest {
    @Test
    void reportsWhereTheContextBrokerCannotNotify() throws Exception {
        HttpServer source = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        var health = new StringBuilder("{\"subscriptions\":[{\"url\":\"http://x/v2/notify\",\"failsInARow\":0}]}");
        source.createContext("/health", exchange -> {
            byte[] body = health.toString().getBytes(UTF_8);
            exchange.sendResponseHeaders(200, body.length);
            exchange.getResponseBody().write(body);
            exchange.close();
        });
        source.start();
        URI page = URI.create("http://127.0.0.1:" + source.getAddress().getPort() + "/health");
        try {
            Connectors connectors = new Connectors(page, page, null);
            assertThat(connectors.undelivered()).isEmpty();

            health.replace(0, health.length(), health.toString().replace(":0", ":3"));

            assertThat(connectors.undelivered())
                    .get()
                    .asString()
                    .startsWith("The context broker could not deliver its last 3 notifications to http://x/v2/notify.");
        } finally {
            source.stop(0);
        }
        assertThat(new Connectors(page, page, null).undelivered())
                .as("of a source that starts again")
                .isEmpty();
    }
}
