package io.furrow.kafka;

import java.time.Clock;
import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class SupervisedWorkerTest {
    private final SupervisedWorker worker = new SupervisedWorker("example", Clock.systemUTC());

    @Test
    void beginsAnewWhateverItsWorkThrows() {
        AtomicInteger runs = new AtomicInteger();
        worker.start(
                self -> {
                    if (runs.incrementAndGet() == 1) {
                        throw new IllegalArgumentException("URI with undefined scheme");
                    }
                    self.succeeded();
                    awaitClosing(self);
                },
                () -> "3 waiting");
        await().until(() -> worker.status().lastSuccess() != null);
        assertThat(worker.status())
                .returns("example", ComponentStatus::name)
                .returns(ComponentStatus.State.UP, ComponentStatus::state)
                .satisfies(status -> assertThat(status.detail())
                        .startsWith("3 waiting; last failure at ")
                        .endsWith(": URI with undefined scheme")
                        .doesNotContain("Exception"));
        worker.close();
        assertThat(worker.status().state()).isEqualTo(ComponentStatus.State.DEAD);
        assertThat(runs).hasValue(2);
    }

    @Test
    void endsAPauseWhenItIsClosed() {
        CountDownLatch begun = new CountDownLatch(1);
        AtomicInteger ended = new AtomicInteger();
        worker.start(
                self -> {
                    begun.countDown();
                    self.pause(Duration.ofDays(1)); // an interrupt would not come to the next line
                    ended.incrementAndGet();
                },
                () -> "nothing waits");
        await().until(() -> begun.getCount() == 0);
        worker.close();
        assertThat(ended).hasValue(1);
    }

    @Test
    void showsThatAnErrorEndedIt() {
        CountDownLatch begun = new CountDownLatch(1);
        worker.start(
                self -> {
                    begun.countDown();
                    throw new NoClassDefFoundError("a/b");
                },
                () -> "nothing waits");
        await().dontCatchUncaughtExceptions().until(() -> worker.status().state() == ComponentStatus.State.DEAD);
        assertThat(begun.getCount()).isZero();
        assertThat(worker.status().detail()).contains("no class def found: a/b", "start the process again");
    }

    private static void awaitClosing(SupervisedWorker self) {
        while (!self.isClosing()) {
            Thread.onSpinWait();
        }
    }
}
