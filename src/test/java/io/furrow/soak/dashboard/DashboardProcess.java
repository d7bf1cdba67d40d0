package io.furrow.soak.dashboard;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import io.furrow.embedded.FreePort;
import io.furrow.process.TestProcess;
import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.Until;

/** Runs {@code furrow dashboard} as a process, so that its heap and threads can be measured alone. */
final class DashboardProcess implements AutoCloseable {
    private static final Duration START_TIMEOUT = Duration.ofSeconds(60);
    private static final Pattern TOTAL = Pattern.compile("(?m)^Total\\s+\\d+\\s+(\\d+)");
    private static final Pattern THREAD = Pattern.compile("(?m)^\"(?!dashboard-(?:work-)?\\d)");
    private static final Pattern POOLED = Pattern.compile("(?m)^\"dashboard-(?:work-)?\\d");

    /**
     * Compacts in every collection. By default three of four collections leave up to a twentieth of the heap
     * uncompacted, and a histogram counts its dead objects as live arrays of int.
     */
    private static final String COMPACT = "-XX:MarkSweepAlwaysCompactCount=1";

    private final Path folder;
    private final URI uri;
    private final JavaProcess process;
    private final HttpClient http = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(Duration.ofSeconds(5))
            .build();
    private int histograms;

    /** Returns once it is ready. */
    DashboardProcess(Path folder, String bootstrapServers, URI controlPlane) throws IOException {
        this.folder = folder;
        int port = FreePort.orFree(0);
        uri = URI.create("http://127.0.0.1:" + port);
        process = new JavaProcess(
                folder.resolve("dashboard.out"),
                List.of("-Xmx256m", "-XX:+UseSerialGC", COMPACT, "-XX:+ExitOnOutOfMemoryError"),
                "io.furrow.launcher.Furrow",
                List.of(
                        "dashboard",
                        "--port",
                        Integer.toString(port),
                        "--kafka",
                        bootstrapServers,
                        "--api",
                        controlPlane.toString(),
                        "--log",
                        folder.resolve("dashboard.log").toString()));
        process.start();
        Until.isTrue("the dashboard is ready", START_TIMEOUT, this::isReady);
    }

    URI uri() {
        return uri;
    }

    private boolean isReady() {
        try {
            return get("/ready").statusCode() == 200;
        } catch (IOException e) {
            return false;
        }
    }

    HttpResponse<String> get(String path) throws IOException {
        try {
            return http.send(
                    HttpRequest.newBuilder(uri.resolve(path))
                            .timeout(Duration.ofSeconds(30))
                            .build(),
                    HttpResponse.BodyHandlers.ofString());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException(e);
        }
    }

    /** The value of a metric. @param name with its labels */
    double metric(String name) {
        try {
            Matcher line = Pattern.compile("(?m)^" + Pattern.quote(name) + " (\\S+)$")
                    .matcher(get("/metrics").body());
            if (!line.find()) {
                throw new IllegalStateException("/metrics has no " + name);
            }
            return Double.parseDouble(line.group(1));
        } catch (IOException e) {
            throw new IllegalStateException("/metrics cannot be read", e);
        }
    }

    /** Bytes of reachable objects after a garbage collection. Writes the histogram by class to a file of the folder. */
    long liveBytes() throws IOException, InterruptedException {
        String histogram = jcmd("GC.class_histogram");
        Files.writeString(folder.resolve("classes-%d.log".formatted(++histograms)), histogram);
        Matcher total = TOTAL.matcher(histogram);
        if (!total.find()) {
            throw new IOException("jcmd shows no total: " + histogram);
        }
        return Long.parseLong(total.group(1));
    }

    /** The number of threads outside of the server's pools, which have at most 96 threads and shrink over minutes. */
    long threads() throws IOException, InterruptedException {
        return THREAD.matcher(jcmd("Thread.print")).results().count();
    }

    long pooledThreads() throws IOException, InterruptedException {
        return POOLED.matcher(jcmd("Thread.print")).results().count();
    }

    private String jcmd(String command) throws IOException, InterruptedException {
        TestProcess.Ended jcmd =
                TestProcess.run(new ProcessBuilder(TestProcess.program("jcmd"), Long.toString(process.pid()), command));
        if (jcmd.status() != 0) {
            throw new IOException("jcmd %s: %s".formatted(command, jcmd.output()));
        }
        return jcmd.output();
    }

    boolean isAlive() {
        return process.isAlive();
    }

    @Override
    public void close() {
        process.close();
    }
}
