package io.furrow.flink.kafka;

import java.io.IOException;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Timeout(60)
class SharedReadsTest {
    private final SharedReads<String, List<String>> reads = new SharedReads<>();
    private final CountDownLatch begun = new CountDownLatch(1);
    private final CountDownLatch goOn = new CountDownLatch(1);

    @Test
    void readOnceForAllWhoAskMeanwhile() throws Exception {
        AtomicInteger count = new AtomicInteger();
        SharedReads.Read<List<String>> read = () -> {
            count.incrementAndGet();
            pause();
            return List.of("a");
        };
        CompletableFuture<List<String>> first = async(read);
        begun.await();
        Joiner second = new Joiner(read);
        await().until(second::isWaiting);

        goOn.countDown();

        assertThat(first.get()).isSameAs(second.result.get()).containsExactly("a");
        assertThat(count).hasValue(1);
        assertThat(reads.size()).isZero();
    }

    @Test
    void readAgainWhereTheOtherFails() throws Exception {
        CompletableFuture<List<String>> first = async(() -> {
            pause();
            throw new IOException("stopped");
        });
        begun.await();
        Joiner second = new Joiner(() -> List.of("b"));
        await().until(second::isWaiting);

        goOn.countDown();

        assertThat(second.result.get()).containsExactly("b");
        assertThatThrownBy(first::get).hasRootCauseMessage("stopped");
        assertThat(reads.size()).isZero();
    }

    @Test
    void keepNothingOfAReadThatHasEnded() throws Exception {
        assertThat(reads.join("topic", () -> List.of("a"))).containsExactly("a");
        assertThat(reads.join("topic", () -> List.of("b"))).containsExactly("b");
    }

    private void pause() throws IOException {
        begun.countDown();
        try {
            goOn.await();
        } catch (InterruptedException e) {
            throw new IOException(e);
        }
    }

    private CompletableFuture<List<String>> async(SharedReads.Read<List<String>> read) {
        return new Joiner(read).result;
    }

    private final class Joiner {
        final CompletableFuture<List<String>> result = new CompletableFuture<>();
        private final Thread thread;

        Joiner(SharedReads.Read<List<String>> read) {
            thread = new Thread(() -> {
                try {
                    result.complete(reads.join("topic", read));
                } catch (IOException e) {
                    result.completeExceptionally(e);
                }
            });
            thread.start();
        }

        boolean isWaiting() {
            return thread.getState() == Thread.State.WAITING;
        }
    }
}
