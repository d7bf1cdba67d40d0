package io.furrow.connect.broker;

import java.io.IOException;
import java.net.http.HttpResponse.BodyHandler;
import java.net.http.HttpResponse.BodySubscriber;
import java.net.http.HttpResponse.BodySubscribers;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Flow.Subscription;

/** Reads the body of an answer up to a number of bytes; a larger one fails. */
final class LimitedBody implements BodySubscriber<byte[]> {
    /** The body was larger. */
    static final class TooLargeException extends IOException {
        private static final long serialVersionUID = 1L;

        private final int status;

        private TooLargeException(int status, long maxBytes) {
            super("the answer is larger than " + maxBytes + " bytes");
            this.status = status;
        }

        int status() {
            return status;
        }
    }

    private final BodySubscriber<byte[]> whole = BodySubscribers.ofByteArray();
    private final int status;
    private final long maxBytes;
    private Subscription subscription;
    private long left;

    private LimitedBody(int status, long maxBytes) {
        this.status = status;
        this.maxBytes = maxBytes;
        left = maxBytes;
    }

    static BodyHandler<byte[]> of(long maxBytes) {
        return answer -> new LimitedBody(answer.statusCode(), maxBytes);
    }

    @Override
    public CompletionStage<byte[]> getBody() {
        return whole.getBody();
    }

    @Override
    public void onSubscribe(Subscription given) {
        subscription = given;
        whole.onSubscribe(given);
    }

    @Override
    public void onNext(List<ByteBuffer> part) {
        if (left < 0) {
            return;
        }
        left -= part.stream().mapToLong(ByteBuffer::remaining).sum();
        if (left < 0) {
            subscription.cancel();
            whole.onError(new TooLargeException(status, maxBytes));
        } else {
            whole.onNext(part);
        }
    }

    @Override
    public void onError(Throwable failure) {
        whole.onError(failure);
    }

    @Override
    public void onComplete() {
        if (left >= 0) {
            whole.onComplete();
        }
    }
}
