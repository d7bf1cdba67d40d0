package io.furrow.connect.source.http;

import java.io.IOException;
import java.net.StandardSocketOptions;
import java.nio.channels.NetworkChannel;
import java.time.Clock;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.zip.ZipException;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.io.EndPoint;
import org.eclipse.jetty.io.EofException;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.source.journal.RecordLog;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.connect.source.notification.ReceivedNotification;
import io.furrow.connect.source.notification.Translation;
import io.furrow.connect.source.option.OverloadOptions;

/**
 * Accepts every request as a notification and answers it when its records are durable. No thread waits for a body, for
 * room or for durability.
 */
public final class NotificationHandler extends Handler.Abstract.NonBlocking {
    private static final Logger LOG = LoggerFactory.getLogger(NotificationHandler.class);

    private final NotificationTranslator translator;
    private final AdmissionQueue admissionQueue;
    private final Ledger ledger;
    private final Limits limits;

    /**
     * @param maxBody bytes of a body
     * @param bodies bytes of all bodies whose senders have no answer yet
     * @param translations bytes of heap that notifications need besides their bodies, from the end of the body to
     *     the answer
     * @param holdNanos maximum time that a sender is held: for memory, and from the end of its body until its
     *     records are durable
     * @param resets whether the connection is then reset rather than answered 503
     */
    public record Limits(int maxBody, ByteBudget bodies, ByteBudget translations, long holdNanos, boolean resets) {}

    public NotificationHandler(
            NotificationTranslator translator, AdmissionQueue admissionQueue, Ledger ledger, Limits limits) {
        this.translator = translator;
        this.admissionQueue = admissionQueue;
        this.ledger = ledger;
        this.limits = limits;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) {
        Memory memory = new Memory(new BodyReader(request, limits.maxBody(), limits.bodies(), limits.holdNanos()));
        memory.reader
                .start()
                .thenCompose(body -> {
                    if (!body.readToEnd()) {
                        response.getHeaders().put(HttpHeader.CONNECTION, "close");
                    }
                    long deadline = System.nanoTime() + limits.holdNanos() - body.heldNanos();
                    return translate(received(request, body), memory, deadline)
                            .thenCompose(translation -> deliver(translation, deadline));
                })
                // On a thread of the server: the thread that completes the delivery is the only one that writes to the
                // disk.
                .whenCompleteAsync(
                        (notificationResponse, failure) -> {
                            memory.release();
                            answer(request, response, notificationResponse, failure, callback);
                        },
                        getServer().getThreadPool());
        return true;
    }

    /** The parts of the budgets that a request holds until it is answered. */
    private final class Memory {
        private final BodyReader reader;
        private long translation;

        Memory(BodyReader reader) {
            this.reader = reader;
        }

        void release() {
            limits.translations().giveBack(translation);
            reader.release();
        }
    }

    private CompletableFuture<Translation> translate(ReceivedNotification received, Memory memory, long deadline) {
        ByteBudget budget = limits.translations();
        long estimate = HeapEstimate.of(received.body());
        boolean fits = estimate <= budget.size() || !received.complete();
        long desired = fits ? Math.min(estimate, budget.size()) : asDeadLetter(received);
        return budget.take(desired, deadline - System.nanoTime()).thenApply(taken -> {
            memory.translation = desired;
            return fits ? translator.translate(received) : translator.refuse(received, tooMuch(estimate, budget));
        });
    }

    private long asDeadLetter(ReceivedNotification received) {
        return Math.min(
                (long) received.body().length * OverloadOptions.HEAP_PER_BYTE,
                limits.translations().size());
    }

    private static String tooMuch(long estimate, ByteBudget memory) {
        return "the notification needs about " + estimate + " bytes of memory, the limit is " + memory.size()
                + "; send fewer entities at a time, or raise " + OverloadOptions.TRANSLATION_MEMORY;
    }

    private CompletableFuture<NotificationResponse> deliver(Translation translation, long deadline) {
        return admissionQueue
                .deliver(translation.records(), deadline)
                .thenApply(durable -> NotificationResponse.taken(translation.refusal()));
    }

    private void answer(
            Request request,
            Response response,
            NotificationResponse notificationResponse,
            Throwable failure,
            Callback callback) {
        Throwable cause = failure instanceof CompletionException ? failure.getCause() : failure;
        if (cause == null) {
            notificationResponse.write(response, callback);
        } else if (cause instanceof OverloadException || cause instanceof RecordLog.ClosedException) {
            ledger.overload.increment();
            if (cause instanceof OverloadException overload && overload.isLate()) {
                ledger.late.increment();
            }
            notDurable(request, response, callback);
        } else if (cause.getCause() instanceof ZipException notGzip) { // Jetty wraps it
            response.getHeaders().put(HttpHeader.CONNECTION, "close");
            NotificationResponse.notGzip(notGzip.getMessage()).write(response, callback);
        } else if (cause instanceof IOException || cause instanceof java.util.concurrent.TimeoutException) {
            ledger.timedOut.increment();
            callback.failed(cause);
        } else {
            LOG.error("a notification could not be processed because of a defect of the source; report it", cause);
            ledger.overload.increment();
            notDurable(request, response, callback);
        }
    }

    private void notDurable(Request request, Response response, Callback callback) {
        if (limits.resets()) {
            reset(request, callback);
        } else {
            response.getHeaders().put(HttpHeader.CONNECTION, "close");
            NotificationResponse.overload().write(response, callback);
        }
    }

    /** Resets the connection: the sender sees a failure, and no half-open connection remains. */
    static void reset(Request request, Callback callback) {
        EndPoint endPoint = request.getConnectionMetaData().getConnection().getEndPoint();
        Object transport = endPoint.getTransport();
        while (transport instanceof EndPoint inner) {
            transport = inner.getTransport();
        }
        try {
            if (transport instanceof NetworkChannel channel) {
                channel.setOption(StandardSocketOptions.SO_LINGER, 0);
            }
        } catch (IOException e) {
            LOG.debug("the sender has already disconnected", e);
        }
        endPoint.close();
        callback.failed(new EofException("overload"));
    }

    private static ReceivedNotification received(Request request, BodyReader.Body body) {
        return ReceivedNotification.of(
                body.bytes(),
                body.complete(),
                request.getHeaders()::get,
                Clock.systemUTC().instant(),
                Request.getRemoteAddr(request) + " " + request.getHttpURI().getPath());
    }
}
