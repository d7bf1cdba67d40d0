package io.furrow.connect.source.http;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class AdmissionQueueTest {
    private static final Duration MINUTE = Duration.ofMinutes(1);
    private static final CompletableFuture<Void> DURABLE = CompletableFuture.completedFuture(null);

    private final Ledger ledger = new Ledger();

    @AutoClose
    private final AdmissionQueue admissionQueue = new AdmissionQueue(this::take, ledger);

    private volatile boolean room;
    private volatile boolean broken;

    @Test
    void goesOnAfterAnErrorWhileSomeWait() {
        CompletableFuture<Void> first = deliver("first");
        CompletableFuture<Void> second = deliver("second");
        broken = true;

        assertThat(first)
                .failsWithin(MINUTE)
                .withThrowableOfType(ExecutionException.class)
                .withCauseInstanceOf(LinkageError.class);
        assertThat(second).failsWithin(MINUTE);
        broken = false;
        CompletableFuture<Void> third = deliver("third");
        room = true;

        assertThat(third).succeedsWithin(MINUTE);
        assertThat(deliver("fourth")).succeedsWithin(MINUTE);
        assertThat(ledger.rejectedUnavailable.sum()).isEqualTo(2);
        await("nobody waits any more").until(() -> {
            long held = ledger.delayed.sum();
            return deliver("fifth").isDone() && ledger.delayed.sum() == held;
        });
    }

    @Test
    void countsWhatAnErrorTurnedAwayAtOnce() {
        room = true;
        broken = true;

        assertThat(deliver("first")).failsWithin(MINUTE);
        assertThat(ledger.rejectedUnavailable.sum()).isEqualTo(1);
    }

    private Optional<CompletableFuture<Void>> take(List<KafkaRecord> records) {
        if (broken) {
            throw new LinkageError("thrown by a test");
        }
        return room ? Optional.of(DURABLE) : Optional.empty();
    }

    private CompletableFuture<Void> deliver(String key) {
        KafkaRecord record = new KafkaRecord("raw", key, new byte[1], Instant.EPOCH, Map.of());
        return admissionQueue.deliver(List.of(record), System.nanoTime() + MINUTE.toNanos());
    }
}
