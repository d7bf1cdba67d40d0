package io.furrow.kafka;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.time.Instant;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.DescribeClusterOptions;

import io.furrow.model.text.FailureText;

/** Probes a service every two seconds on its own thread; the service counts as unavailable after six seconds without an answer. */
public final class Probe implements AutoCloseable {
    private static final Duration INTERVAL = Duration.ofSeconds(2);
    public static final Duration TIMEOUT = Duration.ofSeconds(2);
    private static final Duration UNAVAILABLE_AFTER = Duration.ofSeconds(6);
    private static final int SERVER_ERROR = 500;

    private final String name;
    private final Check check;
    private final Runnable closing;
    private final ScheduledExecutorService executor;
    private volatile Instant lastSuccess;
    private volatile String failure = "not asked yet";

    /** Returns if the service is available. */
    public interface Check {
        void run() throws IOException, InterruptedException, ExecutionException, TimeoutException;
    }

    /** @param closing releases the resources of the check */
    public Probe(String name, Check check, Runnable closing) {
        this.name = name;
        this.check = check;
        this.closing = closing;
        this.executor = Executors.newSingleThreadScheduledExecutor(DaemonThreads.named(name + "-probe"));
        executor.scheduleWithFixedDelay(this::request, 0, INTERVAL.toMillis(), TimeUnit.MILLISECONDS);
    }

    /** Probes a Kafka cluster. @param client settings of Kafka clients */
    public static Probe kafka(Properties client) {
        Admin admin = Admin.create(client);
        DescribeClusterOptions options = new DescribeClusterOptions().timeoutMs((int) TIMEOUT.toMillis());
        return new Probe(
                "kafka",
                () -> admin.describeCluster(options).nodes().get(TIMEOUT.toMillis(), TimeUnit.MILLISECONDS),
                () -> admin.close(Duration.ZERO));
    }

    /** Probes an HTTP server: any answer but a server error counts. @param url of a cheap resource */
    public static Probe http(String name, URI url) {
        HttpClient client = HttpClient.newBuilder()
                .version(HttpClient.Version.HTTP_1_1)
                .connectTimeout(TIMEOUT)
                .build();
        HttpRequest request = HttpRequest.newBuilder(url).timeout(TIMEOUT).GET().build();
        return new Probe(
                name,
                () -> {
                    int status = client.send(request, HttpResponse.BodyHandlers.discarding())
                            .statusCode();
                    if (status >= SERVER_ERROR) {
                        throw new IOException("%s answers %d".formatted(url, status));
                    }
                },
                () -> {});
    }

    private void request() {
        try {
            check.run();
            lastSuccess = Instant.now();
            failure = "";
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (IOException | ExecutionException | TimeoutException | RuntimeException e) { // unavailable
            failure = FailureText.of(e);
        }
    }

    public ComponentStatus status() {
        Instant last = lastSuccess;
        boolean up = last != null && last.plus(UNAVAILABLE_AFTER).isAfter(Instant.now());
        return new ComponentStatus(name, up ? ComponentStatus.State.UP : ComponentStatus.State.DOWN, last, failure);
    }

    @Override
    public void close() {
        executor.shutdownNow();
        closing.run();
    }
}
