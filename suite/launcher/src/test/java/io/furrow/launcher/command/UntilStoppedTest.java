package io.furrow.launcher.command;

import java.util.concurrent.CountDownLatch;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

@Timeout(30)
class UntilStoppedTest {
    private final UntilStopped repeated = new UntilStopped();
    private final CountDownLatch waiting = new CountDownLatch(1);

    /** For instance for a server that is too busy to answer. */
    @Test
    void endsAStepThatWaits() throws Exception {
        Thread stopping = new Thread(this::stopOnceItWaits);
        stopping.start();

        repeated.repeat(this::waitForever);

        assertThat(Thread.currentThread().isInterrupted()).isFalse();
        stopping.join();
    }

    private void stopOnceItWaits() {
        try {
            waiting.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        repeated.stop();
    }

    private void waitForever() throws InterruptedException {
        waiting.countDown();
        new CountDownLatch(1).await();
    }

    @Test
    void doesNotBeginAfterAStop() throws Exception {
        repeated.stop();

        repeated.repeat(() -> assertThat(true).isFalse());
    }

    @Test
    void throwsAnInterruptThatNoStopCaused() {
        assertThatThrownBy(() -> repeated.repeat(() -> Thread.currentThread().interrupt()))
                .isInstanceOf(InterruptedException.class);
    }
}
