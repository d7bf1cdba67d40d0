package io.furrow.control.alarm.action;

import java.net.http.HttpResponse.BodySubscriber;
import java.net.http.HttpResponse.ResponseInfo;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Flow;

/**
 * Reads the beginning of the body of a response and discards the rest, so that the connection can be reused. A body that
 * is too long is canceled together with its connection.
 */
final class BoundedBody implements BodySubscriber<String> {
    static final int MAX_BYTES = 65_536;

    private final CompletableFuture<String> read = new CompletableFuture<>();
    private final ByteBuffer beginning = ByteBuffer.allocate(1024);
    private Flow.Subscription subscription;
    private long bytes;

    static BodySubscriber<String> beginning(ResponseInfo info) {
        return new BoundedBody();
    }

    @Override
    public CompletionStage<String> getBody() {
        return read;
    }

    @Override
    public void onSubscribe(Flow.Subscription newSubscription) {
        subscription = newSubscription;
        subscription.request(1);
    }

    @Override
    public void onNext(List<ByteBuffer> buffers) {
        for (ByteBuffer buffer : buffers) {
            bytes += buffer.remaining();
            beginning.put(buffer.slice().limit(Math.min(buffer.remaining(), beginning.remaining())));
        }
        if (bytes > MAX_BYTES) {
            subscription.cancel();
            onComplete();
        } else {
            subscription.request(1);
        }
    }

    @Override
    public void onError(Throwable failure) {
        read.completeExceptionally(failure);
    }

    @Override
    public void onComplete() {
        read.complete(new String(beginning.array(), 0, beginning.position(), StandardCharsets.UTF_8));
    }
}
