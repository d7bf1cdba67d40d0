package io.furrow.connect.source;

import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.util.concurrent.CompletableFuture;

import org.eclipse.jetty.io.Content;

/**
 * Reads the body of a request without holding a thread, and keeps at most {@code limit} bytes of it. A longer body is read
 * on, up to four times the limit, and dropped: a client that is still writing would not see an answer otherwise. What is
 * kept is taken from a budget; who asked for the body gives it back.
 */
final class BodyReader implements Runnable {
    /**
     * The body, or its beginning.
     *
     * @param complete whether nothing of it was dropped
     * @param readToEnd whether the connection can carry another request
     */
    record Body(byte[] bytes, boolean complete, boolean readToEnd) {}

    /** So many bodies are being read that there is no memory for this one. */
    static final class NoRoomException extends RuntimeException {
        private static final long serialVersionUID = 1L;

        NoRoomException() {
            super("too many bodies are being received");
        }
    }

    /** A client can claim any length: memory beyond this follows what really comes. */
    private static final int LARGEST_FIRST_CAPACITY = 256 * 1024;

    private static final int FIRST_CAPACITY = 4096;

    private final Content.Source source;
    private final int limit;
    private final ByteBudget budget;
    private final ByteArrayOutputStream kept;
    private final CompletableFuture<Body> body = new CompletableFuture<>();
    private long seen;

    private BodyReader(Content.Source source, int limit, ByteBudget budget) {
        this.source = source;
        this.limit = limit;
        this.budget = budget;
        long expected = source.getLength();
        this.kept = new ByteArrayOutputStream(
                expected > 0 ? (int) Math.min(expected, LARGEST_FIRST_CAPACITY) : FIRST_CAPACITY);
    }

    /** The reader of a body that {@link #start} begins to read. */
    static BodyReader of(Content.Source source, int limit, ByteBudget budget) {
        return new BodyReader(source, limit, budget);
    }

    /** The body; failed with an I/O error if the client goes away, with {@link NoRoomException} if there is no memory. */
    CompletableFuture<Body> start() {
        run();
        return body;
    }

    /** Gives what was kept back to the budget; once, after {@link #start} is complete. */
    void release() {
        budget.giveBack(kept.size());
    }

    @Override
    public void run() {
        while (true) {
            Content.Chunk chunk = source.read();
            if (chunk == null) {
                source.demand(this);
                return;
            }
            if (Content.Chunk.isFailure(chunk)) {
                body.completeExceptionally(chunk.getFailure());
                return;
            }
            boolean hadRoom = keep(chunk.getByteBuffer());
            boolean last = chunk.isLast();
            chunk.release();
            if (!hadRoom) {
                body.completeExceptionally(new NoRoomException());
                return;
            }
            if (last || seen > 4L * limit) {
                body.complete(new Body(kept.toByteArray(), seen <= limit, last));
                return;
            }
        }
    }

    /** Whether the budget had room for what is to be kept. */
    private boolean keep(ByteBuffer bytes) {
        seen += bytes.remaining();
        byte[] part = new byte[Math.min(bytes.remaining(), limit - kept.size())];
        if (!budget.tryTake(part.length)) {
            return false;
        }
        bytes.get(part);
        kept.write(part, 0, part.length);
        return true;
    }
}
