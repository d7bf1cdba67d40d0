package io.furrow.connect.source;

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

/** Takes every request for a notification and answers it when its records are durable. No thread waits for a body, for room or for durability. */
final class NotificationHandler extends Handler.Abstract.NonBlocking {
    private static final Logger LOG = LoggerFactory.getLogger(NotificationHandler.class);

    private final NotificationTranslator translator;
    private final Deliveries deliveries;
    private final Ledger ledger;
    private final Limits limits;

    /**
     * @param maxBody bytes of a body
     * @param bodies bytes of all bodies whose senders have no answer yet
     * @param translations bytes of heap that notifications take beside their bodies, from the end of the body to the answer
     * @param holdNanos how long a sender is held at most: for memory, and from the end of its body until its records are durable
     * @param resets whether it then loses its connection, or is answered 503
     */
    record Limits(int maxBody, ByteBudget bodies, ByteBudget translations, long holdNanos, boolean resets) {}

    NotificationHandler(NotificationTranslator translator, Deliveries deliveries, Ledger ledger, Limits limits) {
        this.translator = translator;
        this.deliveries = deliveries;
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
                // On a thread of the server: what completes the delivery is the one thread that writes to the disk.
                .whenCompleteAsync(
                        (answer, failure) -> {
                            memory.release();
                            answer(request, response, answer, failure, callback);
                        },
                        getServer().getThreadPool());
        return true;
    }

    /** What a request holds of the budgets until it is answered. */
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
        long wanted = fits ? Math.min(estimate, budget.size()) : asDeadLetter(received);
        return budget.take(wanted, deadline - System.nanoTime()).thenApply(taken -> {
            memory.translation = wanted;
            return fits ? translator.translate(received) : translator.refuse(received, tooMuch(estimate, budget));
        });
    }

    private long asDeadLetter(ReceivedNotification received) {
        return Math.min(
                (long) received.body().length * HeapEstimate.PER_BYTE,
                limits.translations().size());
    }

    private static String tooMuch(long estimate, ByteBudget memory) {
        return "the notification would take about " + estimate + " bytes of memory, the limit is " + memory.size()
                + "; send fewer entities at a time, or raise " + OverloadOptions.TRANSLATION_MEMORY;
    }

    private CompletableFuture<Answer> deliver(Translation translation, long deadline) {
        return deliveries
                .deliver(translation.records(), deadline)
                .thenApply(durable -> Answer.taken(translation.refusal()));
    }

    private void answer(Request request, Response response, Answer answer, Throwable failure, Callback callback) {
        Throwable cause = failure instanceof CompletionException ? failure.getCause() : failure;
        if (cause == null) {
            answer.write(response, callback);
        } else if (cause instanceof OverloadException || cause instanceof Intake.ClosedException) {
            ledger.overload.increment();
            if (cause instanceof OverloadException overload && overload.isLate()) {
                ledger.late.increment();
            }
            notDurable(request, response, callback);
        } else if (cause.getCause() instanceof ZipException notGzip) { // Jetty wraps it
            response.getHeaders().put(HttpHeader.CONNECTION, "close");
            Answer.notGzip(notGzip.getMessage()).write(response, callback);
        } else if (cause instanceof IOException || cause instanceof java.util.concurrent.TimeoutException) {
            ledger.cut.increment();
            callback.failed(cause);
        } else {
            LOG.error("a notification could not be taken, which is a defect of the source", cause);
            ledger.overload.increment();
            notDurable(request, response, callback);
        }
    }

    private void notDurable(Request request, Response response, Callback callback) {
        if (limits.resets()) {
            reset(request, callback);
        } else {
            response.getHeaders().put(HttpHeader.CONNECTION, "close");
            Answer.overload().write(response, callback);
        }
    }

    /** Cuts the connection with a reset: the sender sees a failure, and no half-open connection is left. */
    private static void reset(Request request, Callback callback) {
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
            LOG.debug("the sender has gone already", e);
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
