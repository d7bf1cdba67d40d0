package io.furrow.deployment;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;

import com.sun.net.httpserver.HttpExchange;
import com.sun.net.httpserver.HttpServer;

/**
 * Passes what is posted to {@code /<port>/…} on to that port, again and again until it is acknowledged: a 2xx; other answers are printed.
 * A context broker sends each notification once; behind this, one that is not in Kafka in the end was acknowledged. It gets an answer
 * before it would count a failure, of which too many end a subscription.
 */
final class NotificationRetries {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final long BACKOFF_MS = 200;
    private static final int HOLD_SECONDS = 4;
    private static final int NOT_YET = 503;
    private static final List<String> PASSED_ON =
            List.of("Content-Type", "Fiware-Service", "Fiware-Servicepath", "Fiware-Correlator", "Ngsiv2-AttrsFormat");

    private static final ExecutorService THREADS = Executors.newCachedThreadPool();
    private static final HttpClient CLIENT = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(TIMEOUT)
            .build();

    private NotificationRetries() {}

    /** Listens on 127.0.0.1 until the process ends. */
    static void start(int port) throws IOException {
        HttpServer server = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), port), 0);
        server.createContext("/", NotificationRetries::pass);
        server.setExecutor(THREADS);
        server.start();
    }

    private static void pass(HttpExchange exchange) throws IOException {
        try (exchange) {
            String[] path = exchange.getRequestURI().getPath().split("/", 3);
            HttpRequest.Builder request = HttpRequest.newBuilder(
                            URI.create("http://127.0.0.1:" + path[1] + "/" + path[2]))
                    .timeout(TIMEOUT)
                    .POST(HttpRequest.BodyPublishers.ofByteArray(
                            exchange.getRequestBody().readAllBytes()));
            PASSED_ON.forEach(name -> exchange.getRequestHeaders()
                    .getOrDefault(name, List.of())
                    .forEach(value -> request.header(name, value)));
            int status = CompletableFuture.supplyAsync(() -> untilAcknowledged(request.build()), THREADS)
                    .completeOnTimeout(NOT_YET, HOLD_SECONDS, TimeUnit.SECONDS)
                    .join();
            exchange.sendResponseHeaders(status, -1);
        }
    }

    private static int untilAcknowledged(HttpRequest request) {
        try {
            int status = send(request);
            while (status / 100 != 2) {
                if (status != 0) {
                    System.out.println("answered " + status + ", sent again");
                }
                TimeUnit.MILLISECONDS.sleep(BACKOFF_MS);
                status = send(request);
            }
            return status;
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    /** @return 0 without an answer */
    private static int send(HttpRequest request) throws InterruptedException {
        try {
            return CLIENT.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
        } catch (IOException e) {
            return 0;
        }
    }
}
