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
 * Forwards a notification posted to {@code /<host>:<port>/…} to that server until it is acknowledged with a 2xx, and prints other status codes. A
 * context broker sends each notification once: with these retries, a notification that is missing in Kafka at the end was acknowledged. The
 * broker gets a response before it counts a failure, because too many failures end a subscription.
 */
final class NotificationRetries {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final long BACKOFF_MS = 200;
    private static final int RESPONSE_TIMEOUT_SECONDS = 4;
    private static final int UNAVAILABLE = 503;
    private static final List<String> FORWARDED_HEADERS =
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
        server.createContext("/", NotificationRetries::forward);
        server.setExecutor(THREADS);
        server.start();
    }

    private static void forward(HttpExchange exchange) throws IOException {
        try (exchange) {
            String[] path = exchange.getRequestURI().getPath().split("/", 3);
            HttpRequest.Builder request = HttpRequest.newBuilder(URI.create("http://" + path[1] + "/" + path[2]))
                    .timeout(TIMEOUT)
                    .POST(HttpRequest.BodyPublishers.ofByteArray(
                            exchange.getRequestBody().readAllBytes()));
            FORWARDED_HEADERS.forEach(name -> exchange.getRequestHeaders()
                    .getOrDefault(name, List.of())
                    .forEach(value -> request.header(name, value)));
            int status = CompletableFuture.supplyAsync(() -> sendUntilAcknowledged(request.build()), THREADS)
                    .completeOnTimeout(UNAVAILABLE, RESPONSE_TIMEOUT_SECONDS, TimeUnit.SECONDS)
                    .join();
            exchange.sendResponseHeaders(status, -1);
        }
    }

    private static int sendUntilAcknowledged(HttpRequest request) {
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

    /** @return 0 without a response */
    private static int send(HttpRequest request) throws InterruptedException {
        try {
            return CLIENT.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
        } catch (IOException e) {
            return 0;
        }
    }
}
