package io.furrow.connect.source;

import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.util.concurrent.CompletableFuture;

import org.eclipse.jetty.io.Content;

/**
 * Reads the body of a request without holding a thread, and keeps at most {@code limit} bytes of it. A longer body is read
 * on, up to four times the limit, and dropped: a client that is still writing would not see an answer otherwise.
 */
final class BodyReader implements Runnable {
    /**
     * The body, or its beginning.
     *
     * @param complete whether nothing of it was dropped
     * @param readToEnd whether the connection can carry another request
     */
    record Body(byte[] bytes, boolean complete, boolean readToEnd) {}

    private static final int FIRST_CAPACITY = 4096;

    private final Content.Source source;
    private final int limit;
    private final ByteArrayOutputStream kept;
    private final CompletableFuture<Body> body = new CompletableFuture<>();
    private long seen;

    private BodyReader(Content.Source source, int limit) {
        this.source = source;
        this.limit = limit;
        long expected = source.getLength();
        this.kept = new ByteArrayOutputStream(expected > 0 && expected <= limit ? (int) expected : FIRST_CAPACITY);
    }

    /** The body; failed with an I/O error if the client goes away before its end. */
    static CompletableFuture<Body> read(Content.Source source, int limit) {
        BodyReader reader = new BodyReader(source, limit);
        reader.run();
        return reader.body;
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
            keep(chunk.getByteBuffer());
            boolean last = chunk.isLast();
            chunk.release();
            if (last || seen > 4L * limit) {
                body.complete(new Body(kept.toByteArray(), seen <= limit, last));
                return;
            }
        }
    }

    private void keep(ByteBuffer bytes) {
        seen += bytes.remaining();
        byte[] part = new byte[Math.min(bytes.remaining(), limit - kept.size())];
        bytes.get(part);
        kept.write(part, 0, part.length);
    }
}
