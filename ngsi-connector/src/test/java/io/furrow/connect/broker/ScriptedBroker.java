package io.furrow.connect.broker;

import java.io.IOException;
import java.net.Authenticator;
import java.net.CookieHandler;
import java.net.ProxySelector;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpHeaders;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.net.http.HttpResponse.BodyHandler;
import java.net.http.HttpResponse.BodySubscriber;
import java.net.http.HttpResponse.BodySubscribers;
import java.net.http.HttpResponse.PushPromiseHandler;
import java.net.http.HttpResponse.ResponseInfo;
import java.nio.ByteBuffer;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.Executor;
import java.util.concurrent.Flow.Subscriber;
import java.util.concurrent.Flow.Subscription;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLParameters;
import javax.net.ssl.SSLSession;

/** A context broker without a network: it gives the answers of a script in their order, and then one that ends all asking. */
public final class ScriptedBroker extends HttpClient {
    private static final int MAX_REQUESTS = 10_000;

    /** What was asked, with its body, and answered. */
    public record Exchange(String method, String path, byte[] body, Script.Reply reply) {
        public boolean isSuccess() {
            return reply.status() / 100 == 2;
        }
    }

    private static final Subscription UNBOUNDED = new Subscription() {
        @Override
        public void request(long n) {}

        @Override
        public void cancel() {}
    };

    private final Script script;
    private final List<Exchange> exchanges = new ArrayList<>();

    public ScriptedBroker(Script script) {
        this.script = script;
    }

    /** A client of it. */
    public BrokerClient client(long maxAnswerBytes) {
        BrokerSettings settings = BrokerSettings.of(URI.create("http://broker:1026"), Duration.ofSeconds(10));
        return new BrokerClient(this, settings.withMaxAnswerBytes(maxAnswerBytes));
    }

    public List<Exchange> exchanges() {
        return exchanges;
    }

    private record Answer<T>(HttpRequest request, int statusCode, HttpHeaders headers, T body)
            implements HttpResponse<T> {
        @Override
        public Optional<HttpResponse<T>> previousResponse() {
            return Optional.empty();
        }

        @Override
        public Optional<SSLSession> sslSession() {
            return Optional.empty();
        }

        @Override
        public URI uri() {
            return request.uri();
        }

        @Override
        public Version version() {
            return Version.HTTP_1_1;
        }
    }

    private record Info(int statusCode, HttpHeaders headers, Version version) implements ResponseInfo {}

    @Override
    public <T> CompletableFuture<HttpResponse<T>> sendAsync(HttpRequest request, BodyHandler<T> handler) {
        if (exchanges.size() == MAX_REQUESTS) {
            throw new IllegalStateException("asks for ever");
        }
        String path = request.uri().getRawPath()
                + Optional.ofNullable(request.uri().getRawQuery())
                        .map(query -> "?" + query)
                        .orElse("");
        Script.Reply reply = script.next(request.method(), path);
        exchanges.add(new Exchange(request.method(), path, body(request), reply));
        HttpHeaders headers = HttpHeaders.of(reply.headers(), (name, value) -> true);
        BodySubscriber<T> body = handler.apply(new Info(reply.status(), headers, Version.HTTP_1_1));
        body.onSubscribe(UNBOUNDED);
        int half = reply.body().length / 2;
        body.onNext(List.of(ByteBuffer.wrap(reply.body(), 0, half)));
        body.onNext(List.of(ByteBuffer.wrap(reply.body(), half, reply.body().length - half)));
        body.onComplete();
        return body.getBody()
                .<HttpResponse<T>>thenApply(whole -> new Answer<>(request, reply.status(), headers, whole))
                .toCompletableFuture();
    }

    private static byte[] body(HttpRequest request) {
        BodySubscriber<byte[]> whole = BodySubscribers.ofByteArray();
        if (request.bodyPublisher().isEmpty()) {
            return new byte[0];
        }
        request.bodyPublisher().get().subscribe(new Subscriber<ByteBuffer>() {
            @Override
            public void onSubscribe(Subscription subscription) {
                whole.onSubscribe(subscription);
            }

            @Override
            public void onNext(ByteBuffer part) {
                whole.onNext(List.of(part));
            }

            @Override
            public void onError(Throwable failure) {
                whole.onError(failure);
            }

            @Override
            public void onComplete() {
                whole.onComplete();
            }
        });
        return whole.getBody().toCompletableFuture().join();
    }

    @Override
    public <T> CompletableFuture<HttpResponse<T>> sendAsync(
            HttpRequest request, BodyHandler<T> handler, PushPromiseHandler<T> pushes) {
        return sendAsync(request, handler);
    }

    @Override
    public <T> HttpResponse<T> send(HttpRequest request, BodyHandler<T> handler) throws IOException {
        return sendAsync(request, handler).join();
    }

    @Override
    public Optional<CookieHandler> cookieHandler() {
        return Optional.empty();
    }

    @Override
    public Optional<Duration> connectTimeout() {
        return Optional.empty();
    }

    @Override
    public Redirect followRedirects() {
        return Redirect.NEVER;
    }

    @Override
    public Optional<ProxySelector> proxy() {
        return Optional.empty();
    }

    @Override
    public SSLContext sslContext() {
        throw new UnsupportedOperationException("it speaks no TLS");
    }

    @Override
    public SSLParameters sslParameters() {
        throw new UnsupportedOperationException("it speaks no TLS");
    }

    @Override
    public Optional<Authenticator> authenticator() {
        return Optional.empty();
    }

    @Override
    public Version version() {
        return Version.HTTP_1_1;
    }

    @Override
    public Optional<Executor> executor() {
        return Optional.empty();
    }
}
