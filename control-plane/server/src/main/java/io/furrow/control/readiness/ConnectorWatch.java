package io.furrow.control.readiness;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.control.Fault;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Polls the connectors and tasks of Kafka Connect every ten seconds. Connect does not restart failed tasks, therefore
 * each is reported on {@code service.faults} once a minute until it runs again.
 */
public final class ConnectorWatch implements AutoCloseable {
    private static final Duration INTERVAL = Duration.ofSeconds(10);
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final Duration REPORT_INTERVAL = Duration.ofMinutes(1);
    private static final int MAX_CAUSE_LENGTH = 300;
    private static final String FAILED = "FAILED";
    private static final String RUNNING = "RUNNING";

    private final HttpClient http = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(TIMEOUT)
            .build();
    private final String connect;
    private final Clock clock;
    private final Producer<String, byte[]> producer;
    private final SupervisedWorker worker;
    private final Map<String, Instant> reported = new TreeMap<>();
    private volatile List<ComponentStatus> connectors = List.of();
    private volatile Instant lastAnswer;
    private volatile String failure = "not asked yet";

    ConnectorWatch(URI connect, Producer<String, byte[]> producer, Clock clock) {
        this.connect = connect.toString().replaceAll("/+$", "");
        this.producer = producer;
        this.clock = clock;
        this.worker = new SupervisedWorker("connector-watch", clock);
    }

    /**
     * Starts polling.
     *
     * @param connect base of its REST API
     * @param client settings of Kafka clients
     */
    public static ConnectorWatch start(URI connect, Properties client) {
        ConnectorWatch watch = new ConnectorWatch(connect, KafkaClients.producer(client), Clock.systemUTC());
        watch.worker.start(watch::watch, () -> "");
        return watch;
    }

    private void watch(SupervisedWorker self) throws InterruptedException {
        while (!self.isClosing()) {
            poll();
            self.pause(INTERVAL);
        }
    }

    void poll() throws InterruptedException {
        try {
            HttpResponse<byte[]> answer = http.send(
                    HttpRequest.newBuilder(URI.create(connect + "/connectors?expand=status"))
                            .timeout(TIMEOUT)
                            .build(),
                    HttpResponse.BodyHandlers.ofByteArray());
            if (answer.statusCode() != 200) { // 409 while its workers rebalance
                throw new IOException("it answers %d".formatted(answer.statusCode()));
            }
            take(NgsiJson.read(answer.body()));
            lastAnswer = clock.instant();
            failure = "";
        } catch (IOException | UnreadableException e) {
            failure = FailureText.of(e);
        }
    }

    private void take(JsonNode all) {
        Map<String, ComponentStatus> parts = new TreeMap<>();
        for (Map.Entry<String, JsonNode> each : all.properties()) {
            JsonNode status = each.getValue().path("status");
            List<String> states = new ArrayList<>();
            List<String> failures = new ArrayList<>();
            describe("", status.path("connector"), states, failures);
            for (JsonNode task : status.path("tasks")) {
                describe("task " + task.path("id").asInt() + " ", task, states, failures);
            }
            if (states.isEmpty() && status.path("tasks").isEmpty()) {
                states.add("has no task");
            }
            parts.put(each.getKey(), part(each.getKey(), states));
            report(each.getKey(), failures);
        }
        reported.keySet().retainAll(parts.keySet());
        connectors = List.copyOf(parts.values());
    }

    /** Adds the state of a connector or task that is not running, and its failure. */
    private static void describe(String subject, JsonNode part, List<String> states, List<String> failures) {
        String state = part.path("state").asText();
        if (state.equals(FAILED)) {
            String cause = FailureText.ofTrace(part.path("trace").asText());
            String begin = cause.length() <= MAX_CAUSE_LENGTH ? cause : cause.substring(0, MAX_CAUSE_LENGTH) + " …";
            failures.add(subject + "failed: " + begin);
        }
        if (!state.equals(RUNNING)) {
            states.add(
                    state.equals(FAILED)
                            ? failures.get(failures.size() - 1)
                            : subject + "is " + state.toLowerCase(Locale.ROOT));
        }
    }

    private ComponentStatus part(String name, List<String> states) {
        ComponentStatus.State state = states.isEmpty() ? ComponentStatus.State.UP : ComponentStatus.State.DOWN;
        return new ComponentStatus(
                "connector " + name, state, states.isEmpty() ? clock.instant() : null, String.join("; ", states));
    }

    private void report(String name, List<String> failures) {
        if (failures.isEmpty()) {
            reported.remove(name);
            return;
        }
        Instant before = reported.get(name);
        if (before == null || !before.plus(REPORT_INTERVAL).isAfter(clock.instant())) {
            reported.put(name, clock.instant());
            String failure = String.join("; ", failures);
            String command = "curl -X POST \"%s/connectors/%s/restart?includeTasks=true&onlyFailed=true\""
                    .formatted(connect, name);
            Fault fault = new Fault(
                    "connector %s: %s. Correct that, then: %s".formatted(name, failure, command),
                    "connector-failed",
                    Map.of("connector", name, "failure", failure, "command", command));
            producer.send(new ProducerRecord<>(Topics.FAULTS, "connector " + name, fault.toBytes()));
        }
    }

    public List<ComponentStatus> statuses() {
        Instant last = lastAnswer;
        boolean up = last != null && last.plus(INTERVAL.multipliedBy(3)).isAfter(clock.instant());
        List<ComponentStatus> all = new ArrayList<>();
        all.add(new ComponentStatus(
                "connect", up ? ComponentStatus.State.UP : ComponentStatus.State.DOWN, last, failure));
        if (up) {
            all.addAll(connectors);
        }
        return all;
    }

    @Override
    public void close() {
        worker.close();
        producer.close(Duration.ZERO);
    }
}
