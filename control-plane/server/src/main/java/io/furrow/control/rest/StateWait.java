package io.furrow.control.rest;

import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Supplier;
import java.util.function.UnaryOperator;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ProblemException;

/** Holds back an answer until the resource has a state, without a thread. */
final class StateWait {
    private static final long POLL_MS = 250;
    private static final int MAX_WAITING = 256;

    private final Executor executor;
    private final AtomicInteger waiting = new AtomicInteger();

    StateWait(Executor executor) {
        this.executor = executor;
    }

    /**
     * Answers a resource as soon as it has one of some states, else as it is after a time.
     *
     * @param resource with its status, which may be of an earlier sequence
     * @param states at {@code /status/state}; none to answer at once
     * @param answer makes the answer of the resource
     * @throws ProblemException if too many requests wait, or of the resource
     */
    CompletionStage<Response> one(
            Supplier<ObjectNode> resource, List<String> states, int seconds, UnaryOperator<ObjectNode> answer) {
        ObjectNode now = resource.get();
        if (states.isEmpty() || has(now, states)) {
            return CompletableFuture.completedFuture(JsonResponses.one(answer.apply(now)));
        }
        if (waiting.incrementAndGet() > MAX_WAITING) {
            waiting.decrementAndGet();
            throw ProblemException.overloaded();
        }
        return poll(resource, states, System.nanoTime() + TimeUnit.SECONDS.toNanos(seconds))
                .whenComplete((reached, failure) -> waiting.decrementAndGet())
                .thenApply(answer)
                .thenApply(JsonResponses::one);
    }

    private CompletableFuture<ObjectNode> poll(Supplier<ObjectNode> resource, List<String> states, long deadline) {
        Executor later = CompletableFuture.delayedExecutor(POLL_MS, TimeUnit.MILLISECONDS, executor);
        return CompletableFuture.supplyAsync(resource, later)
                .thenCompose(now -> has(now, states) || System.nanoTime() - deadline > 0
                        ? CompletableFuture.completedFuture(now)
                        : poll(resource, states, deadline));
    }

    private static boolean has(ObjectNode resource, List<String> states) {
        JsonNode status = resource.path("status");
        return status.path("sequence").asLong() >= resource.path("sequence").asLong()
                && states.contains(status.path("state").asText());
    }
}
