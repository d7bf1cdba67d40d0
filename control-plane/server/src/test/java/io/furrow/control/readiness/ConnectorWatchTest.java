package io.furrow.control.readiness;

import java.net.URI;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.kafka.clients.producer.MockProducer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.clock.SettableClock;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.Probe;
import io.furrow.kafka.Readiness;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.control.Fault;
import io.furrow.model.topic.Topics;
import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class ConnectorWatchTest {
    private static final String TRACE =
            "org.apache.kafka.connect.errors.ConnectException: Exiting\\n\\tat a.B.c(B.java:1)\\nCaused by: "
                    + "io.furrow.connect.sink.api.WrongSettingException: http://orion:1026 answers 401; check the token\\n\\tat a.B.d(B.java:2)";

    private final AtomicReference<String> answer = new AtomicReference<>();
    private final MockProducer<String, byte[]> producer =
            new MockProducer<>(true, null, new StringSerializer(), new ByteArraySerializer());
    private final SettableClock clock = new SettableClock(Instant.parse("2026-03-01T08:00:00Z"));
    private ConnectorWatch watch;

    @AutoClose
    private final StubServer connect = new StubServer(exchange -> {
        boolean isStatusRequest = exchange.getRequestURI().toString().equals("/connectors?expand=status");
        StubServer.answer(exchange, isStatusRequest ? 200 : 404, answer.get());
    });

    @BeforeEach
    void start() {
        watch = new ConnectorWatch(connect.uri("/"), producer, clock);
    }

    @Test
    void showsConnectorsAndReportsAFailedTaskOnceAMinute() throws Exception {
        answer.set(connectors("RUNNING", ""));
        watch.poll();
        assertThat(watch.statuses()).extracting(ComponentStatus::name).containsExactly("connect", "connector sink");
        assertThat(watch.statuses()).extracting(ComponentStatus::state).containsOnly(ComponentStatus.State.UP);
        assertThat(producer.history()).isEmpty();

        answer.set(connectors("FAILED", ",\"trace\":\"" + TRACE + "\""));
        watch.poll();
        clock.pass(Duration.ofSeconds(50));
        watch.poll();
        assertThat(watch.statuses().get(1))
                .returns(ComponentStatus.State.DOWN, ComponentStatus::state)
                .returns("task 0 failed: http://orion:1026 answers 401; check the token", ComponentStatus::detail);
        assertThat(producer.history()).singleElement().satisfies(record -> {
            assertThat(record.topic()).isEqualTo(Topics.FAULTS);
            assertThat(record.key()).isEqualTo("connector sink");
            assertThat(Fault.read(record.value()).text())
                    .startsWith(
                            "connector sink: task 0 failed: http://orion:1026 answers 401; check the token. Correct that")
                    .endsWith("/connectors/sink/restart?includeTasks=true&onlyFailed=true\"");
        });
        clock.pass(Duration.ofSeconds(10));
        watch.poll();
        assertThat(producer.history()).hasSize(2);

        answer.set(connectors("RUNNING", ""));
        clock.pass(Duration.ofSeconds(60));
        watch.poll();
        assertThat(producer.history()).hasSize(2);
    }

    @Test
    void reportsPausedConnectorsAndAnUnavailableConnect() throws Exception {
        answer.set(connectors("PAUSED", ""));
        watch.poll();
        assertThat(watch.statuses().get(1).detail()).isEqualTo("task 0 is paused");
        assertThat(producer.history()).isEmpty();

        answer.set("{\"sink\":{\"status\":{\"connector\":{\"state\":\"RUNNING\"},\"tasks\":[]}}}");
        watch.poll();
        assertThat(watch.statuses().get(1).detail()).isEqualTo("has no task");

        answer.set("<html>");
        watch.poll();
        clock.pass(Duration.ofSeconds(30));
        assertThat(watch.statuses())
                .singleElement()
                .returns("connect", ComponentStatus::name)
                .returns(ComponentStatus.State.DOWN, ComponentStatus::state);
    }

    /** The page is public. */
    @Test
    void showsNoClassNames() throws Exception {
        Readiness readiness = new Readiness(Clock.systemUTC());
        URI unreachable = URI.create("http://127.0.0.1:1/");
        ConnectorWatch unavailable = new ConnectorWatch(unreachable, producer, Clock.systemUTC());
        unavailable.poll();
        readiness.showAll(unavailable::statuses);
        try (Probe probe = Probe.http("contextBroker", unreachable);
                SupervisedWorker worker = new SupervisedWorker("worker", Clock.systemUTC())
                        .start(
                                self -> {
                                    throw new IllegalStateException("disk full");
                                },
                                () -> "")) {
            readiness.show(probe::status);
            readiness.show(worker::status);
            await().until(() -> readiness.readiness().toString().contains("disk full")
                    && !probe.status().detail().contains("not asked yet"));
            assertThat(readiness.readiness().toString())
                    .contains("connection refused")
                    .doesNotContain("Exception", "java.");
        }
    }

    private static String connectors(String state, String more) {
        return ("{'sink':{'status':{'name':'sink','type':'sink','connector':{'state':'RUNNING','worker_id':'w'},"
                        + "'tasks':[{'id':0,'state':'%s','worker_id':'w'%s}]}}}")
                .replace('\'', '"')
                .formatted(state, more);
    }
}
