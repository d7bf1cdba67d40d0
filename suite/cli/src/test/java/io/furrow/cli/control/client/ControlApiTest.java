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

    /** A request reads a part of a topic only, in which there may be no element. */
    @Test
    void followsTheLinksToFurtherPages() {
        List<String> requested = new CopyOnWriteArrayList<>();
        List<String> pages = List.of("[]", "[1,2]", "[3,4]");
        try (StubServer server = new StubServer(exchange -> {
            requested.add(exchange.getRequestURI().toString());
            int page = requested.size() - 1;
            if (page < 2) {
                exchange.getResponseHeaders().add("Link", "<?limit=3&before=%d>; rel=\"next\"".formatted(page));
            }
            StubServer.answer(exchange, 200, pages.get(page));
        })) {
            ControlApi.Page three = new ControlApi(server.uri(""), null).list("/api/dead-letters?limit=3", 3);

            assertThat(three.elements()).hasToString("[1,2,3]");
            assertThat(three.hasMore()).isTrue();
            assertThat(requested)
                    .containsExactly(
                            "/api/dead-letters?limit=3",
                            "/api/dead-letters?limit=3&before=0",
                            "/api/dead-letters?limit=3&before=1");

            requested.remove(2);
            ControlApi.Page all = new ControlApi(server.uri(""), null).list("/api/dead-letters?limit=3", 3);
            assertThat(all.elements()).hasToString("[3,4]");
            assertThat(all.hasMore()).isFalse();

            requested.clear();
            ControlApi.Page two = new ControlApi(server.uri(""), null).list("/api/dead-letters?limit=3", 2);
            assertThat(two.elements()).hasToString("[1,2]");
            assertThat(two.hasMore()).isTrue();
            assertThat(requested).hasSize(2);
        }
    }

    private static String failure(URI api) {
        return catchThrowable(() -> new ControlApi(api, null).send("POST", "/api/missions/m/stop", null))
                .getMessage();
    }
}
