package io.furrow.connect.source.http;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.eclipse.jetty.io.Connection;
import org.eclipse.jetty.io.ssl.SslConnection;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.connect.ledger.Ledger;

/**
 * Closes connections whose request is not answered in time, even if bytes keep trickling in. The idle timeout covers
 * silent connections; this timeout covers senders that keep sending.
 */
final class RequestTimeouts implements Connection.Listener {
    /**
     * The bytes read from a connection when its last request was answered, and the time since when more have arrived.
     */
    private static final class Progress {
        private long bytesBefore;
        private long since;
        private boolean handled;

        synchronized void handled() {
            handled = true;
        }

        synchronized void answered(long bytes) {
            handled = false;
            bytesBefore = bytes;
            since = 0;
        }

        /** Whether a request is with the handler, which counts its result. */
        synchronized boolean isHandled() {
            return handled;
        }

        synchronized boolean isTooSlow(long bytes, long now, long allowedNanos) {
            if (bytes > bytesBefore && since == 0) {
                since = now;
            }
            return since != 0 && now - since > allowedNanos;
        }
    }

    private final Map<Connection, Progress> open = new ConcurrentHashMap<>();
    private final long allowedNanos;
    private final Ledger ledger;

    RequestTimeouts(long allowedNanos, Ledger ledger) {
        this.allowedNanos = allowedNanos;
        this.ledger = ledger;
    }

    @Override
    public void onOpened(Connection connection) {
        if (!(connection instanceof SslConnection)) {
            open.put(connection, new Progress());
        }
    }

    @Override
    public void onClosed(Connection connection) {
        open.remove(connection);
    }

    /** Wraps the handler: when a request is answered, the timeout of its connection starts over. */
    Handler watching(Handler handler) {
        return new Handler.Wrapper(handler) {
            @Override
            public boolean handle(Request request, Response response, Callback callback) throws Exception {
                watch(request);
                return super.handle(request, response, callback);
            }
        };
    }

    private void watch(Request request) {
        Connection connection = request.getConnectionMetaData().getConnection();
        Progress progress = open.get(connection);
        if (progress != null) {
            progress.handled();
            Request.addCompletionListener(request, failure -> progress.answered(connection.getBytesIn()));
        }
    }

    /** Closes the connections that are too slow; call it about every second. */
    void cut() {
        long now = System.nanoTime();
        open.forEach((connection, progress) -> {
            if (progress.isTooSlow(connection.getBytesIn(), now, allowedNanos)) {
                open.remove(connection);
                if (!progress.isHandled()) {
                    ledger.timedOut.increment();
                }
                connection.getEndPoint().close(new java.util.concurrent.TimeoutException("the sender is too slow"));
            }
        });
    }
}
