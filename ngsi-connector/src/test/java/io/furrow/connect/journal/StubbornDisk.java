package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.file.Path;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

import static org.assertj.core.api.Assertions.assertThat;

/** A real disk that holds or fails what it is asked, when it is told to. */
final class StubbornDisk implements Disk {
    private final Disk real = Disk.real();
    private final AtomicInteger syncs = new AtomicInteger();
    private volatile CountDownLatch held = new CountDownLatch(0);
    private volatile CountDownLatch arrived = new CountDownLatch(0);
    private volatile long usable = Long.MAX_VALUE;
    private volatile long usableNext = -1;
    private volatile String failWrites;
    private volatile String failSyncs;
    private volatile String failCreation;
    private volatile boolean failPreparation;

    void holdSyncs() {
        held = new CountDownLatch(1);
        arrived = new CountDownLatch(1);
    }

    void awaitHeldSync() throws InterruptedException {
        assertThat(arrived.await(60, TimeUnit.SECONDS)).isTrue();
    }

    void letSyncsGo() {
        held.countDown();
    }

    int syncs() {
        return syncs.get();
    }

    void usable(long bytes) {
        usable = bytes;
    }

    /** Plenty is reported once more. */
    void usableAfterTheNextQuestion(long bytes) {
        usable = Long.MAX_VALUE;
        usableNext = bytes;
    }

    /** @param message null to let them succeed */
    void failWrites(String message) {
        failWrites = message;
    }

    /** What was written stays in the file, as after a real failure of a sync. */
    void failSyncs(String message) {
        failSyncs = message;
    }

    void failCreation(String message) {
        failCreation = message;
    }

    /** The next file cannot be made ahead, for want of a thread. */
    void failPreparation(boolean fails) {
        failPreparation = fails;
    }

    @Override
    public void prepare(Path folder, long capacity) {
        if (failPreparation) {
            throw new OutOfMemoryError("unable to create native thread");
        }
    }

    @Override
    public SegmentFile create(Path file, ByteBuffer header, long capacity) throws IOException {
        failIf(failCreation);
        SegmentFile created = real.create(file, header, capacity);
        return new SegmentFile() {
            @Override
            public void write(ByteBuffer bytes, long position) throws IOException {
                failIf(failWrites);
                created.write(bytes, position);
            }

            @Override
            public void sync() throws IOException {
                syncs.incrementAndGet();
                arrived.countDown();
                try {
                    held.await();
                } catch (InterruptedException e) {
                    throw new IOException(e);
                }
                failIf(failSyncs);
                created.sync();
            }

            @Override
            public void close() throws IOException {
                created.close();
            }
        };
    }

    private static void failIf(String message) throws IOException {
        if (message != null) {
            throw new IOException(message);
        }
    }

    @Override
    public long usable(Path folder) throws IOException {
        long now = Math.min(usable, real.usable(folder));
        if (usableNext >= 0) {
            usable = usableNext;
            usableNext = -1;
        }
        return now;
    }
}
