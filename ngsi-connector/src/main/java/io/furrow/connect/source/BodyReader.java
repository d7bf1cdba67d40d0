package io.furrow.connect.source;

import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.concurrent.CompletableFuture;

import org.eclipse.jetty.io.Content;

/**
 * Reads the body of a request without holding a thread, and keeps at most {@code limit} bytes of it. A longer body is read
 * on, up to four times the limit, and dropped: a client that is still writing would not see an answer otherwise. What is
 * kept is taken from a budget before it is read; while there is too little, the body stays in the network and its sender is
 * held. Who asked for the body gives the budget back.
 */
final class BodyReader implements Runnable {
    /**
     * The body, or its beginning.
     *
     * @param complete whether nothing of it was dropped
     * @param readToEnd whether the connection can carry another request
     * @param heldNanos how long the sender was held, because the budget had too little
     */
    record Body(byte[] bytes, boolean complete, boolean readToEnd, long heldNanos) {}

    /** A client can claim any length: memory beyond this follows what really comes. */
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

    /** @param holdNanos how long the sender is held at most */
    BodyReader(Content.Source source, int limit, ByteBudget budget, long holdNanos) {
        this.source = source;
        this.limit = limit;
        this.budget = budget;
        this.holdNanos = holdNanos;
    }

    /** The body; failed with an I/O error if the client goes away, with {@link OverloadException} if there is no memory. */
    CompletableFuture<Body> start() {
        long expected = source.getLength();
        int first = expected > 0 ? (int) Math.min(expected, LARGEST_FIRST_CAPACITY) : FIRST_CAPACITY;
        grow(Math.min(first, limit), this);
        return body;
    }

    /** Gives what was kept back to the budget; once, after {@link #start} is complete. */
    void release() {
        budget.giveBack(kept.length);
    }

    /** Reads what there is. */
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
            int wanted = (int) Math.min((long) size + chunk.remaining(), limit);
            if (wanted > kept.length) {
                unread = chunk;
                grow((int) Math.min(Math.max(wanted, 2L * kept.length), limit), this);
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

    /** Goes on when the budget has given the bytes, or fails when the sender was held long enough. */
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
