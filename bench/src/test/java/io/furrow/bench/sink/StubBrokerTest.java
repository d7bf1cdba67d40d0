package io.furrow.bench.sink;

import java.net.InetSocketAddress;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.net.http.HttpResponse.BodyHandlers;
import java.util.BitSet;

import org.junit.jupiter.api.Test;

import io.furrow.bench.http.NotificationRequest;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class StubBrokerTest {
    private final HttpClient client = HttpClient.newHttpClient();

    @Test
    void notesTheEntitiesOfUpdatesAndKnowsNone() throws Exception {
        var entities = NotificationRequest.to(InetSocketAddress.createUnresolved("127.0.0.1", 0), 500, 10);
        String update = "{\"actionType\":\"append\",\"entities\":[%s,%s]}"
                .formatted(text(entities.entityWith(3, 0)), text(entities.entityWith(5, 0)));
        try (StubBroker broker = StubBroker.start()) {
            HttpResponse<String> known = post(broker.uri().resolve("/v2/op/query?limit=1000"), "{}");
            HttpResponse<String> updated = post(broker.uri().resolve("/v2/op/update"), update);

            assertThat(known.body()).isEqualTo("[]");
            assertThat(updated.statusCode()).isEqualTo(204);
            BitSet came = new BitSet();
            came.set(3);
            came.set(5);
            assertThat(broker.numbers()).isEqualTo(came);
            assertThat(broker.entities()).isEqualTo(2);
            assertThat(broker.requests()).isEqualTo(2);
            assertThat(broker.nanos()).isPositive();
        }
    }

    private HttpResponse<String> post(URI uri, String body) throws Exception {
        return client.send(
                HttpRequest.newBuilder(uri).POST(BodyPublishers.ofString(body)).build(), BodyHandlers.ofString());
    }

    private static String text(byte[] json) {
        return new String(json, UTF_8);
    }
}
