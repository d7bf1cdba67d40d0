package io.furrow.connect.source.http;

import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.concurrent.CompletableFuture;

import org.eclipse.jetty.io.Content;

/**
 * Reads the body of a request without blocking a thread and retains at most {@code limit} bytes of it. The rest of a
 * longer body, up to four times the limit, is read and dropped: a client that is still writing would not see an answer
 * otherwise. Bytes are reserved in a budget before they are read; while the budget is exhausted, the body stays in the
 * network and its sender is held. The caller releases the budget.
 */
final class BodyReader implements Runnable {
    /**
     * The body, or its beginning.
     *
     * @param complete whether nothing of it was dropped
     * @param readToEnd whether the connection can carry another request
     * @param heldNanos how long the sender was held because the budget was exhausted
     */
    record Body(byte[] bytes, boolean complete, boolean readToEnd, long heldNanos) {}

    /** A client can claim any length: memory beyond this limit is reserved only for bytes that arrive. */
    private static final int LARGEST_FIRST_CAPACITY = 256 * 1024;

    private static final int FIRST_CAPACITY = 4096;

    private final Content.Source source;
    private final int limit;
    private final ByteBudget budget;
    private final long holdNanos;
    private final CompletableFuture<Body> body = new CompletableFuture<>();
    private byte[] kept = new byte[0];
    private int size;
    private long seen;
    private long heldNanos;
    private Content.Chunk unread;

    /** @param holdNanos maximum time that the sender is held */
    BodyReader(Content.Source source, int limit, ByteBudget budget, long holdNanos) {
        this.source = source;
        this.limit = limit;
        this.budget = budget;
        this.holdNanos = holdNanos;
    }

    /**
     * The body. Failed with an I/O error if the client disconnects, with {@link OverloadException} if memory does not
     * become available.
     */
    CompletableFuture<Body> start() {
        long expected = source.getLength();
        int first = expected > 0 ? (int) Math.min(expected, LARGEST_FIRST_CAPACITY) : FIRST_CAPACITY;
        grow(Math.min(first, limit), this);
        return body;
    }

    /** Returns the reserved bytes to the budget; call it once, after {@link #start} has completed. */
    void release() {
        budget.giveBack(kept.length);
    }

    /** Reads the available bytes. */
    @Override
    public void run() {
        while (!body.isDone()) {
            Content.Chunk chunk = unread == null ? source.read() : unread;
            unread = null;
            if (chunk == null) {
                source.demand(this);
                return;
            }
            if (Content.Chunk.isFailure(chunk)) {
                body.completeExceptionally(chunk.getFailure());
                return;
            }
            int desired = (int) Math.min((long) size + chunk.remaining(), limit);
            if (desired > kept.length) {
                unread = chunk;
                grow((int) Math.min(Math.max(desired, 2L * kept.length), limit), this);
                return;
            }
            boolean last = chunk.isLast();
            keep(chunk.getByteBuffer());
            chunk.release();
            if (last || seen > 4L * limit) {
                body.complete(new Body(trimmed(), seen <= limit, last, heldNanos));
                return;
            }
        }
        dropUnread();
    }

    private void keep(ByteBuffer bytes) {
        seen += bytes.remaining();
        int part = Math.min(bytes.remaining(), limit - size);
        bytes.get(kept, size, part);
        size += part;
    }

    private byte[] trimmed() {
        return size == kept.length ? kept : Arrays.copyOf(kept, size);
    }

    /** Continues when the budget has granted the bytes, or fails when the sender was held for the maximum time. */
    private void grow(int capacity, Runnable next) {
        long asked = System.nanoTime();
        budget.take(capacity - kept.length, holdNanos - heldNanos).whenComplete((taken, noRoom) -> {
            if (noRoom == null) {
                heldNanos += System.nanoTime() - asked;
                kept = Arrays.copyOf(kept, capacity);
                next.run();
            } else {
                dropUnread();
                body.completeExceptionally(noRoom);
            }
        });
    }

    private void dropUnread() {
        if (unread != null) {
            unread.release();
            unread = null;
        }
    }
}
