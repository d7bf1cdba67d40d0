package io.furrow.connect.source;

import java.nio.ByteBuffer;
import java.time.Clock;
import java.time.Duration;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.Supplier;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.connect.ledger.Ledger;

/**
 * {@code POST} on any path takes a notification and is answered when its records are durable; {@code GET /health} shows
 * the counters. No thread waits for a body or for an acknowledgement.
 */
final class NotificationHandler extends Handler.Abstract.NonBlocking {
    private final NotificationTranslator translator;
    private final Intake intake;
    private final Ledger ledger;
    private final Limits limits;
    private final Supplier<byte[]> health;

    /**
     * @param maxBody bytes of a body
     * @param bodies bytes of all bodies whose senders have no answer yet
     * @param ackTimeout how long a sender waits for the acknowledgement
     */
    record Limits(int maxBody, ByteBudget bodies, Duration ackTimeout) {}

    NotificationHandler(
            NotificationTranslator translator, Intake intake, Ledger ledger, Limits limits, Supplier<byte[]> health) {
        this.translator = translator;
        this.intake = intake;
        this.ledger = ledger;
        this.limits = limits;
        this.health = health;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) {
        if (HttpMethod.POST.is(request.getMethod())) {
            take(request, response, callback);
        } else if (HttpMethod.GET.is(request.getMethod())
                && Request.getPathInContext(request).equals("/health")) {
            response.getHeaders().put(HttpHeader.CACHE_CONTROL, "no-store");
            write(response, new Answer(200, health.get(), Map.of()), callback);
        } else {
            write(response, Answer.notAllowed(), callback);
        }
        return true;
    }

    private void take(Request request, Response response, Callback callback) {
        BodyReader reader = BodyReader.of(request, limits.maxBody(), limits.bodies());
        reader.start()
                .thenCompose(body -> {
                    if (!body.readToEnd()) {
                        response.getHeaders().put(HttpHeader.CONNECTION, "close");
                    }
                    return deliver(translator.translate(received(request, body)));
                })
                // On a thread of the server: what completes the delivery is the journal's one writing thread.
                .whenCompleteAsync(
                        (answer, failure) -> {
                            reader.release();
                            answer(response, answer, failure, callback);
                        },
                        getServer().getThreadPool());
    }

    private void answer(Response response, Answer answer, Throwable failure, Callback callback) {
        Throwable cause = failure instanceof CompletionException ? failure.getCause() : failure;
        if (cause == null) {
            write(response, answer, callback);
        } else if (cause instanceof BodyReader.NoRoomException) {
            ledger.overload.increment();
            response.getHeaders().put(HttpHeader.CONNECTION, "close");
            write(response, Answer.full(), callback);
        } else {
            callback.failed(cause);
        }
    }

    private CompletableFuture<Answer> deliver(Translation translation) {
        return intake.take(translation.records())
                .map(durable -> counted(durable, translation)
                        .orTimeout(limits.ackTimeout().toMillis(), TimeUnit.MILLISECONDS)
                        .handle((nothing, failure) ->
                                failure == null ? Answer.taken(translation.refusal()) : notDurable(failure)))
                .orElseGet(() -> {
                    ledger.turnedAway.add(translation.records().size());
                    ledger.overload.increment();
                    return CompletableFuture.completedFuture(Answer.full());
                });
    }

    /** Counted when the intake says so, which may be later than the answer. */
    private CompletableFuture<Void> counted(CompletableFuture<Void> durable, Translation translation) {
        return durable.whenComplete((nothing, failure) -> {
            if (failure != null) {
                ledger.turnedAway.add(translation.records().size());
            }
        });
    }

    private Answer notDurable(Throwable failure) {
        Answer answer = Answer.notDurable(failure).orElseThrow(() -> new CompletionException(failure));
        ledger.overload.increment();
        if (failure instanceof TimeoutException) {
            ledger.late.increment();
        }
        return answer;
    }

    private static ReceivedNotification received(Request request, BodyReader.Body body) {
        return ReceivedNotification.of(
                body.bytes(),
                body.complete(),
                request.getHeaders()::get,
                Clock.systemUTC().instant(),
                Request.getRemoteAddr(request) + " " + request.getHttpURI().getPath());
    }

    private static void write(Response response, Answer answer, Callback callback) {
        response.setStatus(answer.status());
        answer.headers().forEach((name, value) -> response.getHeaders().put(name, value));
        if (answer.body().length > 0) {
            response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
        }
        response.write(true, ByteBuffer.wrap(answer.body()), callback);
    }
}
