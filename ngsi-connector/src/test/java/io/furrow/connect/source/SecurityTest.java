package io.furrow.connect.source;

import java.io.IOException;
import java.net.Socket;
import java.net.http.HttpRequest.BodyPublisher;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;

import org.apache.kafka.common.config.ConfigException;
import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.LogManager;
import org.apache.logging.log4j.core.Appender;
import org.apache.logging.log4j.core.LogEvent;
import org.apache.logging.log4j.core.LoggerContext;
import org.apache.logging.log4j.core.appender.AbstractAppender;
import org.apache.logging.log4j.core.config.LoggerConfig;
import org.apache.logging.log4j.core.config.Property;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class SecurityTest {
    private static final BodyPublisher ENTITY = BodyPublishers.ofString("{\"id\": \"a\"}");
    private static final String NEW = "n3w-S3cret-of-today";
    private static final String OLD = "0ld-S3cret-of-yesterday";

    @Test
    void takesEitherSecretAndNothingElse() {
        try (NotificationRig rig = new NotificationRig("secret", NEW, "secret.previous", OLD)) {
            assertThat(status(rig, "X-Furrow-Secret", NEW)).isEqualTo(200);
            assertThat(status(rig, "x-furrow-secret", OLD)).isEqualTo(200);
            assertThat(status(rig, "X-Furrow-Secret", NEW + "x")).isEqualTo(401);
            assertThat(status(rig, "X-Furrow-Secret", "")).isEqualTo(401);
            assertThat(status(rig, "Authorization", NEW)).isEqualTo(401);
            assertThat(rig.post("/", ENTITY).join().statusCode()).isEqualTo(401);

            assertThat(rig.ledger.unauthorized.sum()).isEqualTo(4);
            assertThat(rig.recordLog.taken).hasSize(2);
            assertThat(rig.ledger.received.sum()).isEqualTo(2);
        }
    }

    @Test
    void refusesOnceTheBodyIsThereAndKeepsTheConnection() throws IOException {
        try (NotificationRig rig = new NotificationRig("secret", NEW);
                Socket socket = new Socket("127.0.0.1", rig.port())) {
            socket.setSoTimeout((int) NotificationRig.TIMEOUT.toMillis());
            String head = "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 11\r\n";
            write(socket, head + "\r\n");
            await().during(Duration.ofMillis(300))
                    .until(() -> socket.getInputStream().available() == 0);
            write(socket, "{\"id\": \"a\"}");
            assertThat(statusLine(socket)).contains("401");

            write(socket, head + "X-Furrow-Secret: " + NEW + "\r\n\r\n{\"id\": \"a\"}");

            await().until(() -> rig.recordLog.taken.size() == 1);
        }
    }

    private static void write(Socket socket, String text) throws IOException {
        socket.getOutputStream().write(text.getBytes(US_ASCII));
        socket.getOutputStream().flush();
    }

    private static String statusLine(Socket socket) throws IOException {
        StringBuilder line = new StringBuilder();
        for (int next = socket.getInputStream().read();
                next >= 0 && next != '\n';
                next = socket.getInputStream().read()) {
            line.append((char) next);
        }
        return line.toString();
    }

    @Test
    void takesTheSecretFromAnyHeader() {
        try (NotificationRig rig = new NotificationRig("secret.header", "Authorization", "secret", "Bearer " + NEW)) {
            assertThat(status(rig, "Authorization", "Bearer " + NEW)).isEqualTo(200);
            assertThat(status(rig, "Authorization", NEW)).isEqualTo(401);
        }
    }

    @Test
    void takesAllowedTenantsOnlyAndKeepsNothingOfTheOthers() {
        try (NotificationRig rig = new NotificationRig("allowed.tenants", "Farm, -")) {
            assertThat(status(rig, "Fiware-Service", "fArm")).isEqualTo(200);
            assertThat(status(rig, "NGSILD-Tenant", "farm")).isEqualTo(200);
            assertThat(rig.post("/", ENTITY).join().statusCode()).isEqualTo(200);
            assertThat(status(rig, "Fiware-Service", "other")).isEqualTo(403);
            assertThat(rig.post("/", BodyPublishers.ofString("no JSON"), "Fiware-Service", "other")
                            .join()
                            .statusCode())
                    .isEqualTo(403);

            assertThat(rig.ledger.foreignTenant.sum()).isEqualTo(2);
            assertThat(rig.recordLog.taken).hasSize(3);
        }
    }

    @Test
    void asksForTheTenantByNameWhereNoneIsNotAllowed() {
        try (NotificationRig rig = new NotificationRig("allowed.tenants", "farm")) {
            assertThat(rig.post("/", ENTITY).join().statusCode()).isEqualTo(403);
        }
    }

    @Test
    void writesNoSecretAnywhere() {
        LoggerContext logging = (LoggerContext) LogManager.getContext(false);
        Recorder recorder = new Recorder();
        LoggerConfig root = logging.getConfiguration().getRootLogger();
        Level level = root.getLevel();
        Map<String, Appender> usual = Map.copyOf(root.getAppenders());
        recorder.start();
        usual.keySet().forEach(root::removeAppender);
        root.addAppender(recorder, Level.TRACE, null);
        root.setLevel(Level.TRACE);
        logging.updateLoggers();
        StringBuilder seen = new StringBuilder();
        try (NotificationRig rig = new NotificationRig("secret", NEW, "secret.previous", OLD)) {
            for (String given : List.of(NEW, OLD, "wr0ng-guess")) {
                HttpResponse<String> answer =
                        post(rig, "X-Furrow-Secret", given).join();
                seen.append(answer.headers().map()).append(answer.body());
            }
            seen.append(rig.get("/health").join().body());
            seen.append(rig.get("/metrics").join().body());
            rig.recordLog.taken.forEach(records ->
                    records.forEach(record -> seen.append(record.headers()).append(new String(record.value()))));
        } finally {
            root.removeAppender("recorder");
            usual.values().forEach(appender -> root.addAppender(appender, null, null));
            root.setLevel(level);
            logging.updateLoggers();
        }
        seen.append(new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal", "secret", NEW, "secret.previous", OLD))
                .values());
        assertThat(recorder.log).contains("NgsiSourceConfig");

        assertThat(seen + recorder.log).doesNotContain(NEW, OLD, "wr0ng-guess");
    }

    @Test
    void doesNotQuoteASecretThatCannotBeUsed() {
        assertThatThrownBy(() -> new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal", "secret", "\u00fc" + NEW)))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("secret")
                .hasMessageNotContaining(NEW);
        assertThatThrownBy(() -> new NgsiSourceConfig(Map.of("secret.previous", OLD)))
                .isInstanceOf(ConfigException.class)
                .hasMessageNotContaining(OLD);
    }

    private static int status(NotificationRig rig, String header, String value) {
        return post(rig, header, value).join().statusCode();
    }

    private static CompletableFuture<HttpResponse<String>> post(NotificationRig rig, String header, String value) {
        return rig.post("/v2/notify", ENTITY, header, value);
    }

    /** Everything that is logged, each line with its logger first. */
    private static final class Recorder extends AbstractAppender {
        private volatile String log = "";

        private Recorder() {
            super("recorder", null, null, true, Property.EMPTY_ARRAY);
        }

        @Override
        public synchronized void append(LogEvent event) {
            boolean library = event.getLoggerName().matches("(jdk|org\\.eclipse\\.jetty)\\..*");
            if (library && event.getLevel().isLessSpecificThan(Level.DEBUG)) {
                return; // Jetty's own debugging shows every header; docs/source.md says so.
            }
            log += event.getLoggerName() + " " + event.getThreadName() + " "
                    + event.getMessage().getFormattedMessage() + " " + event.getThrown() + "\n";
        }
    }
}
