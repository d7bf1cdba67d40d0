package io.furrow.connect.source;

import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse.BodyHandlers;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.process.TestProcess;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class TranslationMemoryTest {
    private static final int LARGEST = 8 * 1024 * 1024;
    private static final int ROUNDS = 6;
    private static final HttpClient CLIENT = HttpClient.newHttpClient();

    /** Short as JSON, long as a tree or as records. */
    private static final List<String> ELEMENTS =
            List.of("0", "1.5", "{}", "[]", "\"a\"", "{\"a\":{}}", "{\"id\":\"a\"}");

    @Test
    void staysWithinAHeapOf128MiBWhateverBodiesBecome(@TempDir Path directory) throws Exception {
        Process source = TestProcess.java(
                        "-Xmx128m -XX:+ExitOnOutOfMemoryError",
                        BlockedSource.class,
                        directory,
                        "max.body.bytes=" + LARGEST,
                        "max.pending.bytes=" + LARGEST,
                        "overload.memory.bytes=" + 2 * LARGEST,
                        "overload.answer=503")
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        try (BufferedReader out = new BufferedReader(new InputStreamReader(source.getInputStream()))) {
            String line = out.readLine();
            assertThat(line).as("the source did not start").startsWith("port ");
            URI uri = URI.create("http://127.0.0.1:" + line.substring(5) + "/v2/notify");

            Map<Integer, Integer> answers = press(uri);

            assertThat(source.isAlive())
                    .as("there was memory for all of it: %s", answers)
                    .isTrue();
            assertThat(answers).containsKeys(200, 400, 413);
            assertThat(post(uri.resolve("/health"), "").join()).isEqualTo(400);
        } finally {
            source.destroyForcibly().waitFor(10, TimeUnit.SECONDS);
        }
    }

    /** All sizes of all elements, all at once, some times; how often there was which answer, -1 for none. */
    private static Map<Integer, Integer> press(URI uri) {
        Map<Integer, Integer> answers = new HashMap<>();
        for (int round = 0; round < ROUNDS; round++) {
            List<CompletableFuture<Integer>> sent = new ArrayList<>();
            for (String element : ELEMENTS) {
                for (int size = LARGEST >> round; size >= 1000; size /= 8) {
                    sent.add(post(uri, body(element, size)));
                }
            }
            sent.forEach(answer -> answers.merge(answer.join(), 1, Integer::sum));
        }
        return answers;
    }

    private static String body(String element, int size) {
        String frame = "{\"subscriptionId\":\"s\",\"data\":[" + element + "]}";
        String more = "," + element;
        return frame.replace("]}", more.repeat((size - frame.length()) / more.length()) + "]}");
    }

    private static CompletableFuture<Integer> post(URI uri, String body) {
        HttpRequest request = HttpRequest.newBuilder(uri)
                .timeout(NotificationRig.TIMEOUT)
                .POST(BodyPublishers.ofString(body, US_ASCII))
                .build();
        return CLIENT.sendAsync(request, BodyHandlers.discarding())
                .handle((answer, failure) -> failure == null ? answer.statusCode() : -1);
    }
}
