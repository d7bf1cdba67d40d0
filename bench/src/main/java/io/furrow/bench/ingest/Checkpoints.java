package io.furrow.bench.ingest;

import java.io.File;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Comparator;
import java.util.OptionalLong;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;

/** The checkpoints of one job on disk, each of which has all its state; Flink deletes older ones meanwhile. */
final class Checkpoints {
    private static final String PREFIX = "chk-";
    /** Written last. */
    private static final String COMPLETE = "_metadata";

    private static final long POLL_INTERVAL_MS = 50;

    private Checkpoints() {}

    /**
     * Awaits a checkpoint that begins after the call.
     *
     * @param folder of the job
     * @return bytes of its files
     */
    static long bytesOfNext(Path folder, Duration timeout) throws InterruptedException {
        long end = System.nanoTime() + timeout.toNanos();
        long begun = checkpoints(folder).mapToLong(Checkpoints::number).max().orElse(0);
        while (System.nanoTime() < end) {
            OptionalLong bytes = bytesAfter(folder, begun);
            if (bytes.isPresent()) {
                return bytes.getAsLong();
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
        }
        throw new IllegalStateException("no checkpoint in " + folder + " in " + timeout.toSeconds() + " s");
    }

    /** Bytes of the newest complete one, if it is later than the given one. */
    static OptionalLong bytesAfter(Path folder, long number) {
        return checkpoints(folder)
                .filter(each -> number(each) > number && new File(each, COMPLETE).exists())
                .max(Comparator.comparingLong(Checkpoints::number))
                .stream()
                .mapToLong(newest -> children(newest).mapToLong(File::length).sum())
                .findFirst();
    }

    private static Stream<File> checkpoints(Path folder) {
        return children(folder.toFile())
                .flatMap(Checkpoints::children)
                .filter(each -> each.getName().startsWith(PREFIX));
    }

    private static long number(File checkpoint) {
        return Long.parseLong(checkpoint.getName().substring(PREFIX.length()));
    }

    private static Stream<File> children(File folder) {
        File[] children = folder.listFiles();
        return children == null ? Stream.empty() : Stream.of(children);
    }
}
