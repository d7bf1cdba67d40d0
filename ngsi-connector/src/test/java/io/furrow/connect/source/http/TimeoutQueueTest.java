package io.furrow.connect.source.http;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class TimeoutQueueTest {
    private static final Duration MINUTE = Duration.ofMinutes(1);

    private final TimeoutQueue timeoutQueue = new TimeoutQueue();

    @Test
    void failsWhatIsNotCompleteByItsDeadline() {
        CompletableFuture<Void> over = watch(-1, "over");
        CompletableFuture<Void> soon = watch(Duration.ofMillis(1).toNanos(), "soon");
        CompletableFuture<Void> far = watch(Duration.ofHours(1).toNanos(), "far");

        assertThat(over)
                .failsWithin(MINUTE)
                .withThrowableOfType(ExecutionException.class)
                .withMessageContaining("over");
        assertThat(soon)
                .failsWithin(MINUTE)
                .withThrowableOfType(ExecutionException.class)
                .withMessageContaining("soon");
        assertThat(far).isNotDone();
    }

    @Test
    void watchesAgainAfterItHadNothingToWatch() {
        for (int i = 0; i < 3; i++) {
            assertThat(watch(-1, "over")).failsWithin(MINUTE);
        }
    }

    @Test
    void leavesWhatIsCompleteAsItIs() {
        List<String> failed = new ArrayList<>();
        CompletableFuture<String> done = CompletableFuture.completedFuture("done");
        timeoutQueue.watch(done, System.nanoTime() - 1, () -> {
            failed.add("done");
            return new IllegalStateException();
        });

        assertThat(watch(-1, "over")).failsWithin(MINUTE);
        assertThat(done).isCompletedWithValue("done");
        assertThat(failed).isEmpty();
    }

    private CompletableFuture<Void> watch(long nanos, String name) {
        CompletableFuture<Void> future = new CompletableFuture<>();
        timeoutQueue.watch(future, System.nanoTime() + nanos, () -> new IllegalStateException(name));
        return future;
    }
}
