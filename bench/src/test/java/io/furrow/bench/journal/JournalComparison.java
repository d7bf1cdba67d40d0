package io.furrow.bench.journal;

import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.LongStream;

import io.furrow.files.Folders;

/**
 * Appends records of 1 kB from several threads to each journal; every append returns when the disk has it. Prints records per
 * second and the time of an append. Arguments: folder on the disk to measure, seconds for each line.
 */
public final class JournalComparison {
    private static final int RECORD = 1000;
    private static final PrintStream OUT = System.out;
    private static final List<Integer> APPENDERS = List.of(1, 16, 64, 256);

    /** A journal whose append returns when the record is on the disk. */
    interface Candidate extends AutoCloseable {
        void append(byte[] record) throws Exception;

        @Override
        void close() throws IOException;
    }

    /** Opens a candidate in an empty folder. */
    interface Opening {
        Candidate open(Path folder) throws Exception;
    }

    private JournalComparison() {}

    public static void main(String... args) throws Exception {
        Path folder = Files.createDirectories(Path.of(args[0]));
        Duration each = Duration.ofSeconds(Long.parseLong(args[1]));
        OUT.println("| journal | appenders | records/s | p50 ms | p99 ms |");
        OUT.println("|---|---|---|---|---|");
        for (int appenders : APPENDERS) {
            measure("own segment log", OwnJournal::new, folder, appenders, each);
            measure("Artemis journal, NIO", ArtemisJournal::new, folder, appenders, each);
            measure("RocksDB, synced WAL", RocksJournal::new, folder, appenders, each);
        }
        System.exit(0);
    }

    private static void measure(String name, Opening opening, Path parent, int appenders, Duration each)
            throws Exception {
        Path folder = Files.createTempDirectory(parent, "0-");
        try (Candidate journal = opening.open(folder)) {
            run(journal, appenders, each.dividedBy(2));
            long[] nanos = run(journal, appenders, each);
            OUT.printf(
                    "| %s | %d | %,d | %.2f | %.2f |%n",
                    name,
                    appenders,
                    nanos.length * 1000L / each.toMillis(),
                    nanos[nanos.length / 2] / 1e6,
                    nanos[(int) (nanos.length * 0.99)] / 1e6);
        }
        Folders.delete(folder);
    }

    private static long[] run(Candidate journal, int appenders, Duration howLong) throws InterruptedException {
        long end = System.nanoTime() + howLong.toNanos();
        long[][] nanos = new long[appenders][];
        CountDownLatch done = new CountDownLatch(appenders);
        AtomicReference<Exception> failed = new AtomicReference<>();
        for (int i = 0; i < appenders; i++) {
            int appender = i;
            new Thread(() -> {
                        try {
                            nanos[appender] = append(journal, end);
                        } catch (Exception e) { // a candidate may throw anything; the measure is void then
                            failed.compareAndSet(null, e);
                        } finally {
                            done.countDown();
                        }
                    })
                    .start();
        }
        if (!done.await(howLong.toSeconds() + 60, TimeUnit.SECONDS) || failed.get() != null) {
            throw new IllegalStateException("an appender failed or hangs", failed.get());
        }
        return Arrays.stream(nanos).flatMapToLong(LongStream::of).sorted().toArray();
    }

    private static long[] append(Candidate journal, long end) throws Exception {
        byte[] record = new byte[RECORD];
        new Random(1).nextBytes(record);
        long[] nanos = new long[1024];
        int count = 0;
        for (long now = System.nanoTime(); now < end; ) {
            journal.append(record);
            long after = System.nanoTime();
            nanos = count == nanos.length ? Arrays.copyOf(nanos, count * 2) : nanos;
            nanos[count++] = after - now;
            now = after;
        }
        return Arrays.copyOf(nanos, count);
    }
}
