package io.furrow.dashboard.feed;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.http.Problem;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class InitialStateReaderTest {
    private final CountDownLatch begun = new CountDownLatch(1);
    private final CountDownLatch finish = new CountDownLatch(1);
    private final AtomicInteger reads = new AtomicInteger();
    private final InitialStateReader reader = new InitialStateReader(this::read);

    private List<FeedRecord> read(String topic) {
        if (topic.equals("broken")) {
            throw new Problem(503, "too-slow", "it took too long");
        }
        if (topic.equals("long")) {
            reads.incrementAndGet();
            begun.countDown();
            try {
                finish.await();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
        return new ArrayList<>();
    }

    @AfterEach
    void close() {
        finish.countDown();
        reader.close();
    }

    @Test
    void readsOnceForAllRequestsDuringARead() throws Exception {
        CompletableFuture<List<FeedRecord>> first = reader.read("long");
        begun.await();
        List<CompletableFuture<List<FeedRecord>>> later = new ArrayList<>();
        for (int i = 0; i < 20; i++) {
            later.add(reader.read("long"));
        }
        assertThat(later).containsOnly(later.get(0)).doesNotContain(first);

        finish.countDown();

        assertThat(later.get(0).get(30, TimeUnit.SECONDS)).isNotSameAs(first.get(30, TimeUnit.SECONDS));
        assertThat(reads).hasValue(2);
    }

    @Test
    void readsOtherTopicsDuringASlowRead() throws Exception {
        CompletableFuture<List<FeedRecord>> slow = reader.read("long");
        begun.await();

        for (int i = 0; i < 20; i++) {
            assertThat(reader.read("short-" + i).get(30, TimeUnit.SECONDS)).isEmpty();
        }
        assertThat(slow).isNotDone();
    }

    @Test
    void readsAgainAfterAFailure() {
        for (int i = 0; i < 2; i++) {
            assertThatThrownBy(() -> reader.read("broken").get(30, TimeUnit.SECONDS))
                    .hasCauseInstanceOf(Problem.class);
        }
    }
}
