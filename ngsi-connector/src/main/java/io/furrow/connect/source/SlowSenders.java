package io.furrow.connect.source;

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
 * Cuts connections on which a request has begun and is not answered in time, however many of its bytes trickle in: a silent
 * connection is the idle timeout's, this is for those that keep sending.
 */
final class SlowSenders implements Connection.Listener {
    /** What was read of a connection when its last request was answered, and since when more has come. */
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

        /** Whether a request is with the handler, who counts what becomes of it. */
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

    SlowSenders(long allowedNanos, Ledger ledger) {
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

    /** Hands each request on: when it is answered, its connection is in time again. */
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

    /** Cuts those that are too slow; to be called about every second. */
    void cut() {
        long now = System.nanoTime();
        open.forEach((connection, progress) -> {
            if (progress.isTooSlow(connection.getBytesIn(), now, allowedNanos)) {
                open.remove(connection);
                if (!progress.isHandled()) {
                    ledger.cut.increment();
                }
                connection.getEndPoint().close(new java.util.concurrent.TimeoutException("the sender is too slow"));
            }
        });
    }
}
