package io.furrow.dashboard.proxy;

import java.nio.ByteBuffer;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;

import org.eclipse.jetty.websocket.api.Callback;
import org.eclipse.jetty.websocket.api.Session;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.StreamCounters.Closing;
import io.furrow.dashboard.feed.StreamCounters.Count;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.ngsi.NgsiJson;

/** One WebSocket: sends the records of its topic, and writes incoming messages to it. */
public final class TopicSocket implements Session.Listener.AutoDemanding, OpenStream {
    /** Close codes of RFC 6455 and its registry. */
    static final int POLICY = 1008;

    static final int TRY_AGAIN_LATER = 1013;
    static final int GOING_AWAY = 1001;

    private static final Logger LOG = LoggerFactory.getLogger(TopicSocket.class);
    private static final long SECOND_NANOS = TimeUnit.SECONDS.toNanos(1);
    private static final int MAX_REASON_LENGTH = 120;
    /** Time after which a connection that did not become a socket is closed. */
    private static final long OPEN_TIMEOUT_NANOS = TimeUnit.SECONDS.toNanos(5);

    private final TopicStreams streams;
    private final Tickets.Ticket ticket;
    private final StreamLimits limits;
    private final SendQueue queue;
    private final long openedAt = System.nanoTime();
    private volatile User user;
    /**
     * Completes when the stream has begun and earlier messages were written, so that a client that writes at once also
     * receives the effects.
     */
    private CompletableFuture<Void> written = new CompletableFuture<>();

    private Session session;
    private boolean sending;
    private boolean closed;
    private long secondStart;
    private int messages;

    TopicSocket(TopicStreams streams, Tickets.Ticket ticket, StreamLimits limits) {
        this.streams = streams;
        this.ticket = ticket;
        this.user = ticket.user();
        this.limits = limits;
        this.queue = new SendQueue(ticket.request(), limits, streams.counters());
    }

    @Override
    public Credentials credentials() {
        return ticket.credentials();
    }

    @Override
    public long openedAt() {
        return openedAt;
    }

    @Override
    public void refresh(User current) {
        user = current;
    }

    @Override
    public void revoke(String reason) {
        end(POLICY, reason, Closing.USER);
    }

    @Override
    public void onWebSocketOpen(Session opened) {
        synchronized (this) {
            session = opened;
        }
        if (isClosed()) {
            opened.disconnect();
            return;
        }
        CompletableFuture<Void> begun = written;
        streams.begin(ticket.request(), this, queue).thenAccept(begun::complete);
    }

    @Override
    public void offer(FeedRecord record) {
        if (!queue.offer(record)) {
            end(
                    TRY_AGAIN_LATER,
                    "too slow: more than %d records or %d bytes wait"
                            .formatted(limits.waitingRecords(), limits.waitingBytes()),
                    Closing.TOO_SLOW);
        }
    }

    /** Sends the next frame unless one is being sent; the callback sends the following one. */
    @Override
    public void flush() {
        Session to;
        String frame;
        synchronized (this) {
            if (closed || sending || session == null) {
                return;
            }
            frame = queue.poll();
            if (frame == null) {
                return;
            }
            sending = true;
            to = session;
        }
        to.sendText(frame, Callback.from(this::sent, this::failed));
    }

    private void sent() {
        synchronized (this) {
            sending = false;
        }
        flush();
    }

    private void failed(Throwable failure) {
        LOG.debug("a socket of {} is gone", ticket.request().topic(), failure);
        closed(Closing.CLIENT);
    }

    @Override
    public synchronized boolean isClosed() {
        return closed;
    }

    @Override
    public void end(String reason) {
        end(TRY_AGAIN_LATER, reason, Closing.TOPIC);
    }

    /** A client that does not read does not receive the close frame; it is disconnected some seconds later. */
    void end(int code, String reason, Closing why) {
        Session to;
        synchronized (this) {
            to = session;
        }
        if (closed(why) && to != null) {
            to.close(code, reason.substring(0, Math.min(reason.length(), MAX_REASON_LENGTH)), Callback.NOOP);
            streams.disconnectLater(to::disconnect);
        }
    }

    @Override
    public void ping() {
        Session to;
        boolean neverOpened;
        synchronized (this) {
            to = closed ? null : session;
            neverOpened = session == null && System.nanoTime() - openedAt > OPEN_TIMEOUT_NANOS;
        }
        if (neverOpened) { // the handshake failed after the ticket was used, which Jetty does not report
            closed(Closing.CLIENT);
        }
        if (to != null) {
            to.sendPing(ByteBuffer.allocate(0), Callback.NOOP);
        }
    }

    @Override
    public void onWebSocketText(String message) {
        try {
            count();
        } catch (Problem problem) {
            reject(problem);
            return;
        }
        written = written.handle((done, failure) -> {
            write(message);
            return null;
        });
    }

    private void write(String message) {
        try {
            streams.writer().write(ticket.request().topic(), user, message).whenComplete((at, failure) -> {
                if (failure instanceof Problem problem) {
                    reject(problem);
                    return;
                }
                streams.counters().add(Count.MESSAGES_WRITTEN, 1);
                if (ticket.request().format() == StreamRequest.Format.RECORD) {
                    send(NgsiJson.write(NgsiJson.object()
                            .set(
                                    "written",
                                    NgsiJson.object()
                                            .put("partition", at.partition())
                                            .put("offset", at.offset()))));
                }
            });
        } catch (Problem problem) {
            reject(problem);
        }
    }

    private void reject(Problem problem) {
        streams.counters().rejected(problem);
        send(problem.json());
    }

    private synchronized void count() {
        long now = System.nanoTime();
        if (now - secondStart > SECOND_NANOS) {
            secondStart = now;
            messages = 0;
        }
        if (++messages > limits.messagesPerSecond()) {
            throw new Problem(
                    429,
                    "too-many-messages",
                    "more than %d messages in a second; this one was not written"
                            .formatted(limits.messagesPerSecond()));
        }
    }

    private void send(byte[] json) {
        queue.addControlFrame(new String(json, java.nio.charset.StandardCharsets.UTF_8));
        flush();
    }

    @Override
    public void onWebSocketClose(int code, String reason) {
        closed(Closing.CLIENT);
    }

    @Override
    public void onWebSocketError(Throwable failure) {
        LOG.debug("a socket of {} failed", ticket.request().topic(), failure);
        closed(Closing.CLIENT);
    }

    /** Returns whether it was open until now. */
    private boolean closed(Closing why) {
        synchronized (this) {
            if (closed) {
                return false;
            }
            closed = true;
        }
        queue.close();
        streams.end(ticket.request().topic(), this, why);
        return true;
    }
}
