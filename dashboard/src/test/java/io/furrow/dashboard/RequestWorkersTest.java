package io.furrow.dashboard;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.IntStream;

import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.thread.QueuedThreadPool;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.http.Problem;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class RequestWorkersTest {
    private static final int SERVER_THREADS = 8;

    private final CountDownLatch released = new CountDownLatch(1);
    private final AtomicInteger running = new AtomicInteger();
    private final List<Problem> rejections = new CopyOnWriteArrayList<>();
    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final Server server = new Server(new QueuedThreadPool(SERVER_THREADS));
    private URI uri;

    /** Blocks requests below {@code /api/} until they are released. */
    private final class BlockingHandler extends Handler.Abstract {
        @Override
        public boolean handle(Request request, Response response, Callback callback) throws Exception {
            String path = Request.getPathInContext(request);
            if (path.equals("/api/nothing")) {
                return false;
            } else if (path.equals("/api/broken")) {
                throw new IllegalStateException("broken");
            } else if (path.startsWith("/api/")) {
                running.incrementAndGet();
                released.await();
            }
            response.write(true, null, callback);
            return true;
        }
    }

    @BeforeEach
    void start() throws Exception {
        ServerConnector connector = new ServerConnector(server, 1, 1);
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        server.setHandler(new RequestWorkers(path -> path.startsWith("/api/"), rejections::add, new BlockingHandler()));
        server.start();
        uri = URI.create("http://127.0.0.1:" + connector.getLocalPort());
    }

    @AfterEach
    void stop() throws Exception {
        released.countDown();
        server.stop();
    }

    private CompletableFuture<HttpResponse<String>> request(String path) {
        return http.sendAsync(HttpRequest.newBuilder(uri.resolve(path)).build(), HttpResponse.BodyHandlers.ofString());
    }

    @Test
    void answersOtherRequestsWhileSomeWait() {
        List<CompletableFuture<HttpResponse<String>>> waiting = IntStream.range(
                        0, RequestWorkers.THREADS + SERVER_THREADS)
                .mapToObj(i -> request("/api/topics"))
                .toList();
        await().until(() -> running.get() == RequestWorkers.THREADS);

        assertThat(request("/health").join().statusCode()).isEqualTo(200);
        assertThat(waiting).noneMatch(CompletableFuture::isDone);
        released.countDown();
        assertThat(waiting).allMatch(each -> each.join().statusCode() == 200);
        assertThat(running).hasValue(RequestWorkers.THREADS + SERVER_THREADS);
    }

    @Test
    void rejectsRequestsBeyondTheQueue() {
        List<CompletableFuture<HttpResponse<String>>> waiting = IntStream.range(
                        0, RequestWorkers.THREADS + RequestWorkers.WAITING + 1)
                .mapToObj(i -> request("/api/topics"))
                .toList();
        await().until(() -> waiting.stream().anyMatch(CompletableFuture::isDone));

        HttpResponse<String> answer = waiting.stream()
                .filter(CompletableFuture::isDone)
                .findFirst()
                .orElseThrow()
                .join();
        assertThat(answer.statusCode()).isEqualTo(503);
        assertThat(answer.body()).contains("overloaded");
        assertThat(answer.headers().firstValue("Retry-After")).contains("1");
        assertThat(rejections).extracting(Problem::error).containsOnly("overloaded");
        released.countDown();
        assertThat(waiting.stream().filter(each -> each.join().statusCode() == 200))
                .hasSize(RequestWorkers.THREADS + RequestWorkers.WAITING);
    }

    @Test
    void answersWith404Or500IfTheHandlerDoesNotHandleOrFails() {
        assertThat(request("/api/nothing").join().statusCode()).isEqualTo(404);
        assertThat(request("/api/broken").join().statusCode()).isEqualTo(500);
    }
}
