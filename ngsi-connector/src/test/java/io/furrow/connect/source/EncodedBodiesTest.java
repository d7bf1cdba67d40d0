package io.furrow.connect.source;

import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.util.Arrays;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.record.KafkaRecord;
import io.furrow.files.Gzip;
import io.furrow.model.event.DeadLetter;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class EncodedBodiesTest {
    private static final int LIMIT = 100_000;

    @ParameterizedTest
    @ValueSource(ints = {0, 1000, 60_000})
    void areInflated(int length) {
        String body = "{\"id\": \"a\", \"x\": \"" + "x".repeat(length) + "\"}";
        try (NotificationRig rig = new NotificationRig("max.body.bytes", Integer.toString(LIMIT))) {
            assertThat(post(rig, Gzip.of(body.getBytes(UTF_8)), "gzip").statusCode())
                    .isEqualTo(200);

            KafkaRecord record = rig.recordLog.taken.remove().get(0);
            assertThat(record.key()).isEqualTo("a");
            assertThat(new String(record.value(), UTF_8)).contains("x".repeat(length));
        }
    }

    @Test
    void areAsLongAsTheyAreInflated() {
        byte[] bomb = Gzip.of("x".repeat(50_000_000).getBytes(UTF_8));
        try (NotificationRig rig = new NotificationRig("max.body.bytes", Integer.toString(LIMIT))) {
            HttpResponse<String> answer = post(rig, bomb, "gzip");

            assertThat(bomb.length).isLessThan(LIMIT);
            assertThat(answer.statusCode()).isEqualTo(413);
            assertThat(answer.headers().firstValue("Connection")).contains("close");
            KafkaRecord dead = rig.recordLog.taken.remove().get(0);
            assertThat(dead.headers()).containsEntry(DeadLetter.REASON, "too-large");
            assertThat(dead.value()).hasSize(LIMIT);
        }
    }

    @Test
    void areRefusedWhereTheyAreNoGzip() {
        try (NotificationRig rig = new NotificationRig()) {
            HttpResponse<String> answer = post(rig, "{\"id\": \"a\"}".getBytes(UTF_8), "gzip");

            assertThat(answer.statusCode()).isEqualTo(400);
            assertThat(answer.body()).contains("gzip");
            assertThat(rig.recordLog.taken).isEmpty();
            assertThat(rig.post("{\"id\": \"a\"}").join().statusCode()).isEqualTo(200);
        }
    }

    @Test
    void areNoEntityWhereTheirEndIsMissing() {
        byte[] whole = Gzip.of(("{\"id\": \"a\", \"x\": \"" + "xyz".repeat(1000) + "\"}").getBytes(UTF_8));
        try (NotificationRig rig = new NotificationRig()) {
            HttpResponse<String> answer = post(rig, Arrays.copyOf(whole, whole.length / 2), "gzip");

            assertThat(answer.statusCode()).isEqualTo(400);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"br", "deflate", "gzip, gzip"})
    void areRefusedInOtherEncodings(String encoding) {
        try (NotificationRig rig = new NotificationRig()) {
            HttpResponse<String> answer = post(rig, Gzip.of("{\"id\": \"a\"}".getBytes(UTF_8)), encoding);

            assertThat(answer.statusCode()).isEqualTo(415);
            assertThat(answer.headers().firstValue("Accept-Encoding")).contains("gzip");
            assertThat(answer.body()).contains("Content-Encoding");
            assertThat(rig.recordLog.taken).isEmpty();
        }
    }

    @Test
    void areNotInflatedForWhoeverMayNotSend() {
        try (NotificationRig rig = new NotificationRig("secret", "s3cret")) {
            assertThat(post(rig, new byte[] {1, 2, 3}, "gzip").statusCode()).isEqualTo(401);
        }
    }

    private static HttpResponse<String> post(NotificationRig rig, byte[] body, String encoding) {
        return rig.post("/v2/notify", BodyPublishers.ofByteArray(body), "Content-Encoding", encoding)
                .join();
    }
}
