package io.furrow.flink.format;

import java.lang.ref.WeakReference;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicReference;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(120)
class SharedByTasksTest {
    private final SharedByTasks<byte[]> shared = new SharedByTasks<>(() -> new byte[1 << 20]);
    private final CountDownLatch end = new CountDownLatch(1);

    @Test
    void isOneForAllTasksAndGoesWithTheLastOfThem() throws Exception {
        AtomicReference<byte[]> seen = new AtomicReference<>();
        Thread first = task(seen);
        WeakReference<byte[]> ofFirst = new WeakReference<>(seen.getAndSet(null));
        Thread second = task(seen);
        assertThat(seen.getAndSet(null)).isSameAs(ofFirst.get());
        System.gc();
        assertThat(ofFirst.get()).as("two tasks run").isNotNull();

        end.countDown();
        first.join();
        second.join();

        await().until(() -> {
            System.gc();
            return ofFirst.get() == null;
        });
    }

    /** Runs until the end, and has used what is shared. */
    private Thread task(AtomicReference<byte[]> seen) throws InterruptedException {
        CountDownLatch used = new CountDownLatch(1);
        Thread thread = new Thread(() -> {
            seen.set(shared.get());
            used.countDown();
            try {
                end.await();
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        });
        thread.start();
        used.await();
        return thread;
    }
}
