package io.furrow.fiware;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.DynamicTest;
import org.junit.jupiter.api.TestFactory;

import io.furrow.fiware.RecordedExchange.Answer;

import static org.assertj.core.api.Assertions.assertThat;

/** The stand-in is asked what Orion and the IoT Agent were asked, in the same order, and answers the same. */
class RecordedExchangesTest {
    @AutoClose
    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());

    @TestFactory
    Stream<DynamicTest> answersAsRecorded() throws Exception {
        Map<Integer, Set<String>> named = RecordedExchange.namedDifferences();
        Map<RecordedExchange, Answer> answers =
                new ExchangeClient(standIn.contextBroker(), standIn.iotAgent(), standIn.contextBroker()).sendAll();
        List<DynamicTest> tests = new ArrayList<>();
        answers.forEach((exchange, answer) -> tests.add(DynamicTest.dynamicTest(
                exchange.toString(),
                () -> assertThat(exchange.differences(answer))
                        .as("answered %s, recorded %s", answer, exchange.json())
                        .isEqualTo(named.getOrDefault(exchange.line(), Set.of())))));
        tests.add(DynamicTest.dynamicTest(
                "every named difference is of an exchange",
                () -> assertThat(answers.keySet().stream().map(RecordedExchange::line))
                        .hasSize(88)
                        .containsAll(named.keySet())));
        return tests.stream();
    }
}
