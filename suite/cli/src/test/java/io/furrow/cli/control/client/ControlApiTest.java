package io.furrow.cli.control.client;

import java.net.URI;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import com.sun.net.httpserver.HttpExchange;
import org.junit.jupiter.api.Test;

import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.catchThrowable;

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

    @Test
    void distinguishesWhyThereIsNoAnswer() {
        try (StubServer lost = new StubServer(HttpExchange::close);
                StubServer proxy = new StubServer(exchange -> StubServer.answer(exchange, 413, "<html>"))) {
            assertThat(failure(lost.uri("")))
                    .startsWith("The control plane at %s has not answered (".formatted(lost.uri("")))
                    .endsWith(" It may have carried a command out.");
            assertThat(failure(proxy.uri(""))).startsWith(proxy.uri("") + " answers 413 and what is not JSON");
        }
        assertThat(failure(URI.create("http://no-such-host.invalid")))
                .isEqualTo(
                        "No control plane is at http://no-such-host.invalid: there is no host of this name. Check --api.");
        assertThat(failure(URI.create("http://127.0.0.1:1"))).startsWith("No control plane answers at ");
    }

    private static String failure(URI api) {
        return catchThrowable(() -> new ControlApi(api, null).send("POST", "/api/missions/m/stop", null))
                .getMessage();
    }
}
