package io.furrow.dashboard;

import java.io.IOException;
import java.io.InputStream;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.Properties;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Server-sent events over more than a minute. */
@Tag("full")
class LongEventStreamIT {
    private static final String VERA = "vera-reads-only-0001";
    private static final String OLGA = "olga-commands-000001";
    private static final String TOPIC = "data.farm.realtime.quiet";
    private static final Duration TIMEOUT = Duration.ofSeconds(120);
    /** A comment is sent every 15 s; the server closes a connection that is idle for 30 s. */
    private static final int MIN_PINGS = 3;

    private final HttpClient http = HttpClient.newHttpClient();

    /** Reads a stream on its own thread. */
    private static final class Reader implements Runnable {
        private final InputStream in;
        private final StringBuilder text = new StringBuilder();
        private volatile boolean ended;

        Reader(InputStream in) {
            this.in = in;
            Thread thread = new Thread(this, "reader");
            thread.setDaemon(true);
            thread.start();
        }

        @Override
        public void run() {
            byte[] buffer = new byte[8192];
            try (in) {
                for (int n = in.read(buffer); n >= 0; n = in.read(buffer)) {
                    synchronized (this) {
                        text.append(new String(buffer, 0, n, UTF_8));
                    }
                }
            } catch (IOException e) {
                synchronized (this) {
                    text.append("broken: ").append(e);
                }
            }
            ended = true;
        }

        synchronized long lines(String prefix) {
            return text.toString()
                    .lines()
                    .filter(line -> line.startsWith(prefix))
                    .count();
        }

        /** Comments that prevent an idle timeout. */
        long pings() {
            return lines(":") - lines(": " + TOPIC);
        }
    }

    @Test
    void streamsStayOpenWithoutRecordsAndEndWhenTheirTokenIsRevoked(@TempDir Path directory) throws Exception {
        Path tokens = directory.resolve("tokens");
        Files.writeString(tokens, "vera %s viewer%nolga %s operator%n".formatted(VERA, OLGA));
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"))) {
            Properties client = kafka.client();
            kafka.createTopics(List.of(new NewTopic(TOPIC, Optional.of(1), Optional.empty())));

            try (RestApi api = RestApi.start(
                            ControlSettings.of(client),
                            RestSettings.on(0).withTokens(tokens),
                            new Readiness(Clock.systemUTC()));
                    Dashboard dashboard = Dashboard.start(DashboardSettings.of(0, client, api.uri()));
                    KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                            kafka.producerSettings(), new StringSerializer(), new ByteArraySerializer())) {
                await().atMost(TIMEOUT).until(api::isReady);
                Reader vera = new Reader(stream(dashboard, VERA).body());
                Reader olga = new Reader(stream(dashboard, OLGA).body());

                await().atMost(TIMEOUT).until(() -> vera.pings() >= MIN_PINGS && olga.pings() >= MIN_PINGS);
                producer.send(new ProducerRecord<>(TOPIC, "k", "{\"n\":1}".getBytes(UTF_8)))
                        .get();
                await().atMost(TIMEOUT)
                        .until(() -> vera.lines("data: {\"records\"") == 1 && olga.lines("data: {\"records\"") == 1);

                SocketClient writer = SocketClient.open(http, socket(dashboard, OLGA));
                Files.writeString(tokens, "olga %s viewer%n".formatted(OLGA));
                await().atMost(TIMEOUT).until(() -> {
                    writer.send("[]");
                    return writer.frames().stream().anyMatch(frame -> frame.contains("'olga' is viewer"));
                });
                assertThat(writer.isOver()).isFalse();
                await().atMost(TIMEOUT).until(() -> vera.ended);
                assertThat(vera.lines("broken")).isZero();
                assertThat(stream(dashboard, VERA).statusCode()).isEqualTo(401);
                assertThat(dashboard.streams().open()).isEqualTo(2);
                producer.send(new ProducerRecord<>(TOPIC, "k", "{\"n\":2}".getBytes(UTF_8)))
                        .get();
                await().atMost(TIMEOUT).until(() -> olga.lines("data: {\"records\"") == 2);
                assertThat(vera.lines("data: {\"records\"")).isEqualTo(1);
            }
        }
    }

    private URI socket(Dashboard dashboard, String token) throws Exception {
        HttpResponse<byte[]> answer = http.send(
                HttpRequest.newBuilder(dashboard.uri().resolve("/api/register/" + Topics.DOMAIN_MANAGER))
                        .header("Authorization", "Bearer " + token)
                        .build(),
                HttpResponse.BodyHandlers.ofByteArray());
        String path = NgsiJson.read(answer.body()).path("socket").asText();
        return URI.create(dashboard.uri().toString().replace("http", "ws") + path);
    }

    private HttpResponse<InputStream> stream(Dashboard dashboard, String token) throws Exception {
        return http.send(
                HttpRequest.newBuilder(dashboard.uri().resolve("/api/stream/" + TOPIC))
                        .header("Authorization", "Bearer " + token)
                        .build(),
                HttpResponse.BodyHandlers.ofInputStream());
    }
}
