package io.furrow.control.rest;

import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.UnaryOperator;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.core.Response;
import org.junit.jupiter.api.Test;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class StateWaitTest {
    private final StateWait waits = new StateWait(Runnable::run);

    @Test
    void answersWhenTheStateIsReached() throws Exception {
        AtomicInteger reads = new AtomicInteger();

        Response answer = waits.one(
                        () -> state(reads.incrementAndGet() < 3 ? "starting" : "running"),
                        List.of("running"),
                        60,
                        UnaryOperator.identity())
                .toCompletableFuture()
                .get(30, TimeUnit.SECONDS);

        assertThat(new String((byte[]) answer.getEntity(), UTF_8)).contains("running");
        assertThat(reads).hasValue(3);
    }

    /** As that of a replay that was told to continue. */
    @Test
    void waitsForTheStatusOfTheNewestSequence() throws Exception {
        AtomicInteger reads = new AtomicInteger();

        waits.one(() -> state("ended", reads.getAndIncrement()), List.of("ended"), 60, UnaryOperator.identity())
                .toCompletableFuture()
                .get(30, TimeUnit.SECONDS);

        assertThat(reads).hasValue(3);
    }

    @Test
    void letsAsManyWaitAsItsMaximum() {
        for (int i = 0; i < 256; i++) {
            waits.one(() -> state("starting"), List.of("running"), 1, UnaryOperator.identity());
        }

        assertThatThrownBy(() -> waits.one(() -> state("starting"), List.of("running"), 1, UnaryOperator.identity()))
                .isInstanceOf(ProblemException.class);
        assertThat(waits.one(() -> state("running"), List.of("running"), 1, UnaryOperator.identity()))
                .isCompleted();
    }

    private static ObjectNode state(String state) {
        return state(state, 2);
    }

    private static ObjectNode state(String state, long sequence) {
        ObjectNode resource = NgsiJson.object().put("sequence", 2);
        resource.putObject("status").put("state", state).put("sequence", sequence);
        return resource;
    }
}
