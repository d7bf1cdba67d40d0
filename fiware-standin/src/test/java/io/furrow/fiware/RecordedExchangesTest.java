package io.furrow.fiware;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.DynamicTest;
import org.junit.jupiter.api.TestFactory;

import io.furrow.fiware.RecordedExchange.Answer;

import static org.assertj.core.api.Assertions.assertThat;

/** The stand-in is asked what Orion and the IoT Agent were asked, in the same order, and answers the same. */
class RecordedExchangesTest {
    private static final String NEUTRAL_ID = "0".repeat(24);

    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());
    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private String subscription = "";

    @AfterEach
    void stop() {
        standIn.close();
    }

    @TestFactory
    Stream<DynamicTest> answersAsRecorded() throws Exception {
        Map<Integer, Set<String>> named = RecordedExchange.namedDifferences();
        Map<RecordedExchange, Answer> answers = new LinkedHashMap<>();
        for (RecordedExchange exchange : RecordedExchange.all()) {
            answers.put(exchange, ask(exchange));
        }
        List<DynamicTest> tests = new ArrayList<>();
        answers.forEach((exchange, answer) -> tests.add(DynamicTest.dynamicTest(
                exchange.toString(),
                () -> assertThat(exchange.differences(answer))
                        .as("answered %s, recorded %s", answer, exchange.json())
                        .isEqualTo(named.getOrDefault(exchange.line(), Set.of())))));
        tests.add(DynamicTest.dynamicTest(
                "every named difference is of an exchange",
                () -> assertThat(answers.keySet().stream().map(RecordedExchange::line))
                        .hasSize(105)
                        .containsAll(named.keySet())));
        return tests.stream();
    }

    private Answer ask(RecordedExchange exchange) throws IOException, InterruptedException {
        URI base = exchange.isForContextBroker() ? standIn.contextBroker() : standIn.iotAgent();
        String path = exchange.path().replace("SUB", subscription).replace(">", "%3E");
        String body = exchange.body().replace("\"CB\"", "\"" + standIn.contextBroker() + "\"");
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
        return text.replace("127.0.0.1:" + standIn.contextBroker().getPort(), "CB")
                .replace("127.0.0.1:" + standIn.iotAgent().getPort(), "AGENT")
                .replaceAll("\\b[0-9a-f]{24}\\b", NEUTRAL_ID);
    }
}
