package io.furrow.dashboard.proxy;

import java.io.IOException;
import java.nio.charset.StandardCharsets;

import jakarta.servlet.AsyncContext;
import jakarta.servlet.AsyncEvent;
import jakarta.servlet.AsyncListener;
import jakarta.servlet.ServletOutputStream;
import jakarta.servlet.WriteListener;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.StreamCounters.Closing;

/** Sends a topic as server-sent events. Writes only when the connection is ready, and never blocks. */
final class EventStream implements OpenStream, WriteListener, AsyncListener {
    private static final Logger LOG = LoggerFactory.getLogger(EventStream.class);

    private final TopicStreams streams;
    private final String topic;
    private final Credentials credentials;
    private final AsyncContext context;
    private final SendQueue queue;
    private final ServletOutputStream out;
    private final long openedAt = System.nanoTime();
    private boolean opened;
    private boolean pingDue;
    private boolean closed;

    EventStream(TopicStreams streams, String topic, Credentials credentials, AsyncContext context, SendQueue queue)
            throws IOException {
        this.streams = streams;
        this.topic = topic;
        this.credentials = credentials;
        this.context = context;
        this.queue = queue;
        this.out = context.getResponse().getOutputStream();
    }

    @Override
    public void offer(FeedRecord record) {
        if (!queue.offer(record)) {
            LOG.debug("a stream of {} is too slow", topic);
            end(Closing.TOO_SLOW);
        }
    }

    @Override
    public Credentials credentials() {
        return credentials;
    }

    @Override
    public long openedAt() {
        return openedAt;
    }

    @Override
    public void ping() {
        synchronized (this) {
            pingDue = true;
        }
        onWritePossible();
    }

    @Override
    public void revoke(String reason) {
        end(Closing.USER);
    }

    @Override
    public void flush() {
        onWritePossible();
    }

    @Override
    public synchronized void onWritePossible() {
        try {
            if (!opened && !closed && out.isReady()) {
                opened = true;
                out.print(": " + topic + "\n\n");
                if (out.isReady()) {
                    out.flush();
                }
            }
            boolean wrote = writePing();
            while (!closed && out.isReady()) {
                String frame = queue.poll();
                if (frame == null) {
                    if (wrote) {
                        out.flush();
                    }
                    return;
                }
                out.write(("data: " + frame.replace("\n", "\ndata: ") + "\n\n").getBytes(StandardCharsets.UTF_8));
                wrote = true;
            }
        } catch (IOException e) {
            onError(e);
        }
    }

    /** Writes a comment, which clients skip, if a ping is due. @return whether it must be flushed */
    private boolean writePing() throws IOException {
        if (!pingDue || closed || !out.isReady()) {
            return false;
        }
        pingDue = false;
        out.print(":\n\n");
        return true;
    }

    @Override
    public void end(String reason) {
        LOG.debug("a stream of {} ends: {}", topic, reason);
        end(Closing.TOPIC);
    }

    private void end(Closing reason) {
        if (close(reason)) {
            context.complete();
        }
    }

    @Override
    public synchronized boolean isClosed() {
        return closed;
    }

    @Override
    public void onError(Throwable failure) {
        LOG.debug("a stream of {} is gone", topic, failure);
        end(Closing.CLIENT);
    }

    private boolean close(Closing reason) {
        synchronized (this) {
            if (closed) {
                return false;
            }
            closed = true;
        }
        queue.close();
        streams.end(topic, this, reason);
        return true;
    }

    @Override
    public void onComplete(AsyncEvent event) {
        close(Closing.CLIENT);
    }

    @Override
    public void onTimeout(AsyncEvent event) {
        end(Closing.CLIENT);
    }

    @Override
    public void onError(AsyncEvent event) {
        close(Closing.CLIENT);
    }

    @Override
    public void onStartAsync(AsyncEvent event) {
        // nothing to do
    }
}
