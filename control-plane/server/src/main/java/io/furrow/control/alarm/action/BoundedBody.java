package io.furrow.control.alarm.action;

import java.net.http.HttpResponse.BodySubscriber;
import java.net.http.HttpResponse.ResponseInfo;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Flow;

/**
 * Discards the body of a response, so that the connection can be reused. A body that is too long is canceled together
 * with its connection.
 */
final class BoundedBody implements BodySubscriber<Void> {
    static final int MAX_BYTES = 65_536;

    private final CompletableFuture<Void> read = new CompletableFuture<>();
    private Flow.Subscription subscription;
    private long bytes;

    static BodySubscriber<Void> discarding(ResponseInfo info) {
        return new BoundedBody();
    }

    @Override
    public CompletionStage<Void> getBody() {
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
        }
        if (bytes > MAX_BYTES) {
            subscription.cancel();
            read.complete(null);
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
        read.complete(null);
    }
}
