package io.furrow.fiware;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.fiware.RecordedExchange.Answer;

/** Asks a context broker and an IoT Agent what was recorded, in the same order. */
final class ExchangeClient {
    private static final String NEUTRAL_ID = "0".repeat(24);

    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final URI contextBroker;
    private final URI iotAgent;
    private final URI brokerOfAgent;
    private String subscription = "";

    /** @param brokerOfAgent where the IoT Agent reaches the context broker */
    ExchangeClient(URI contextBroker, URI iotAgent, URI brokerOfAgent) {
        this.contextBroker = contextBroker;
        this.iotAgent = iotAgent;
        this.brokerOfAgent = brokerOfAgent;
    }

    Map<RecordedExchange, Answer> sendAll() throws IOException, InterruptedException {
        Map<RecordedExchange, Answer> answers = new LinkedHashMap<>();
        for (RecordedExchange exchange : RecordedExchange.all()) {
            answers.put(exchange, send(exchange));
        }
        return answers;
    }

    private Answer send(RecordedExchange exchange) throws IOException, InterruptedException {
        URI base = exchange.isForContextBroker() ? contextBroker : iotAgent;
        String path = exchange.path().replace("SUB", subscription).replace(">", "%3E");
        String body = exchange.body().replace("\"CB\"", "\"" + brokerOfAgent + "\"");
        HttpRequest.Builder request = HttpRequest.newBuilder(base.resolve(path))
                .method(
                        exchange.method(),
                        body.isEmpty()
                                ? HttpRequest.BodyPublishers.noBody()
                                : HttpRequest.BodyPublishers.ofString(body));
        exchange.headers().forEach(request::header);
        HttpResponse<String> response = http.send(request.build(), HttpResponse.BodyHandlers.ofString());
        String location = response.headers().firstValue("Location").orElse(null);
        if (subscription.isEmpty() && location != null && location.startsWith("/v2/subscriptions/")) {
            subscription = location.substring(location.lastIndexOf('/') + 1);
        }
        return new Answer(
                response.statusCode(),
                location == null ? null : neutral(location),
                response.headers().firstValue("Fiware-Total-Count").orElse(null),
                neutral(response.body()));
    }

    private String neutral(String text) {
        return text.replace(brokerOfAgent.getAuthority(), "CB")
                .replace(iotAgent.getAuthority(), "AGENT")
                .replaceAll("\\b[0-9a-f]{24}\\b", NEUTRAL_ID);
    }
}
