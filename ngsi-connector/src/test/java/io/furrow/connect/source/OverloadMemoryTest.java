package io.furrow.connect.source;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.condition.EnabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class OverloadMemoryTest {
    private static final int SENDERS = 200;
    private static final int BODY = 1024 * 1024;

    /** 200 senders of 1 MiB have 200 MiB to give: more than the heap and the memory beside it hold together. */
    @Test
    @EnabledOnOs(OS.LINUX)
    void keepsItsMemoryWhileSendersPressAndNothingIsTakenFromIt(@TempDir Path directory) throws Exception {
        Process source = TestProcess.java(
                        "-Xmx96m -XX:MaxDirectMemorySize=64m -XX:+ExitOnOutOfMemoryError",
                        BlockedSource.class,
                        directory)
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        try (BufferedReader out = new BufferedReader(new InputStreamReader(source.getInputStream()))) {
            int port = port(out);
            PressingSenders senders = new PressingSenders(port, BODY);

            senders.press(SENDERS, Duration.ofSeconds(4));
            long early = residentKiB(source);
            senders.press(SENDERS, Duration.ofSeconds(4));
            long late = residentKiB(source);

            assertThat(source.isAlive()).isTrue();
            assertThat(senders.cut()).as("the journal was full").isPositive();
            assertThat(health(port)).contains("\"durable\":").doesNotContain("\"overload\":0,");
            assertThat(late).as("KiB resident, after %s", early).isLessThan(early + 64 * 1024);
        } finally {
            source.destroyForcibly().waitFor(10, TimeUnit.SECONDS);
        }
    }

    private static int port(BufferedReader out) throws IOException {
        String line = out.readLine();
        while (line != null && !line.startsWith("port ")) {
            line = out.readLine();
        }
        assertThat(line).as("the source did not start").isNotNull();
        return Integer.parseInt(line.substring(5));
    }

    private static long residentKiB(Process process) throws IOException {
        return Files.readAllLines(Path.of("/proc", Long.toString(process.pid()), "status")).stream()
                .filter(line -> line.startsWith("VmRSS:"))
                .mapToLong(line -> Long.parseLong(line.replaceAll("\\D", "")))
                .findFirst()
                .orElseThrow();
    }

    private static String health(int port) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(URI.create("http://127.0.0.1:" + port + "/health"))
                .timeout(Duration.ofSeconds(10))
                .build();
        return HttpClient.newHttpClient()
                .send(request, HttpResponse.BodyHandlers.ofString())
                .body();
    }
}
