package io.furrow.cli.control.client;

import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import org.junit.jupiter.api.Test;

import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ControlApiTest {
    /** Proxies refuse a request whose length is unknown. */
    @Test
    void sendsThePostOfACommandWithoutMembersWithItsLength() {
        List<String> received = new CopyOnWriteArrayList<>();
        try (StubServer server = new StubServer(exchange -> {
            received.add("%s %s %s %s"
                    .formatted(
                            exchange.getRequestMethod(),
                            exchange.getRequestHeaders().getFirst("Content-Length"),
                            exchange.getRequestHeaders().getFirst("Content-Type"),
                            new String(exchange.getRequestBody().readAllBytes(), UTF_8)));
            StubServer.answer(exchange, 200, "{}");
        })) {
            ControlApi api = new ControlApi(server.uri(""), null);

            api.send("POST", "/api/missions/m/stop", null);
            api.send("DELETE", "/api/missions/m", null);
        }

        assertThat(received).containsExactly("POST 2 application/json {}", "DELETE null null ");
    }
}
