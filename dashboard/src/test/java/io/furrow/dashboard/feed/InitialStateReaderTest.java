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
    private final StateBudget budget = new StateBudget(100);
    private final CountDownLatch begun = new CountDownLatch(1);
    private final CountDownLatch finish = new CountDownLatch(1);
    private final AtomicInteger reads = new AtomicInteger();
    private final InitialStateReader reader = new InitialStateReader(this::read);

    private InitialState.State read(String topic) {
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
        StateBudget.Share share = budget.share();
        share.resize(1, topic);
        return new InitialState.State(List.of(), share);
    }

    @AfterEach
    void close() {
        finish.countDown();
        reader.close();
    }

    @Test
    void readsOnceForAllRequestsDuringARead() throws Exception {
        CompletableFuture<InitialState.State> first = reader.read("long");
        begun.await();
        List<CompletableFuture<InitialState.State>> later = new ArrayList<>();
        for (int i = 0; i < 20; i++) {
            later.add(reader.read("long"));
        }
        assertThat(later).containsOnly(later.get(0)).doesNotContain(first);

        finish.countDown();

        assertThat(later.get(0).get(30, TimeUnit.SECONDS)).isNotSameAs(first.get(30, TimeUnit.SECONDS));
        assertThat(reads).hasValue(2);
    }

    @Test
    void releasesTheMemoryWithTheLastRequest() throws Exception {
        CompletableFuture<InitialState.State> first = reader.read("long");
        begun.await();
        reader.read("long");
        CompletableFuture<InitialState.State> shared = reader.read("long");
        finish.countDown();
        first.get(30, TimeUnit.SECONDS).share().release();

        StateBudget.Share share = shared.get(30, TimeUnit.SECONDS).share();
        share.release();
        assertThat(budget.used()).as("of the other request").isOne();
        share.release();
        assertThat(budget.used()).isZero();
    }

    @Test
    void readsOtherTopicsDuringASlowRead() throws Exception {
        CompletableFuture<InitialState.State> slow = reader.read("long");
        begun.await();

        for (int i = 0; i < 20; i++) {
            assertThat(reader.read("short-" + i).get(30, TimeUnit.SECONDS).records())
                    .isEmpty();
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
