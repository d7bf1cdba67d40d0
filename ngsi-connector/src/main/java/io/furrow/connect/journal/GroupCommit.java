package io.furrow.connect.journal;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.function.BooleanSupplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Collects appends while the disk is busy and writes them with one sync. An error fails only those appends of its group
 * that are not durable; the next group starts a new file. After {@value #FAILURES_AT_MOST} failed groups in a row the
 * journal accepts no more appends.
 */
final class GroupCommit {
    private static final Logger LOG = LoggerFactory.getLogger(GroupCommit.class);

    private static final int FAILURES_AT_MOST = 3;
    private static final long GROUP_BYTES = 16L * 1024 * 1024;
    private static final Duration CLOSE_WITHIN = Duration.ofSeconds(10);

    private record Append(List<byte[]> payloads, long bytes, CompletableFuture<Void> durable) {}

    private final String journal;
    private final SegmentWriter writer;
    private final JournalQuota room;
    private final ArrayDeque<Append> queue = new ArrayDeque<>();
    private Thread thread;
    private long waitingBytes;
    private long skippedTo;
    private boolean closed;
    private Throwable failure;
    private int failuresInARow;

    GroupCommit(String journal, SegmentWriter writer, JournalQuota room) {
        this.journal = journal;
        this.writer = writer;
        this.room = room;
    }

    synchronized Optional<CompletableFuture<Void>> append(List<byte[]> payloads) {
        if (payloads.stream().anyMatch(payload -> payload.length == 0)) {
            throw new IllegalArgumentException("a record has a byte at least");
        }
        if (closed) {
            return Optional.of(CompletableFuture.failedFuture(new JournalException.Closed()));
        }
        if (failure != null) {
            return Optional.of(CompletableFuture.failedFuture(new JournalException.DiskFailed(failure)));
        }
        if (payloads.isEmpty()) {
            return Optional.of(CompletableFuture.completedFuture(null));
        }
        long bytes = JournalQuota.sizeOf(payloads);
        if (!room.isFor(bytes, waitingBytes)) {
            return Optional.empty();
        }
        CompletableFuture<Void> durable = new CompletableFuture<>();
        queue.add(new Append(payloads, bytes, durable));
        waitingBytes += bytes;
        startThread();
        notifyAll();
        return Optional.of(durable);
    }

    /** A journal that is only read needs no thread. */
    private void startThread() {
        if (thread == null) {
            thread = new Thread(this::run, "journal-" + journal);
            thread.setDaemon(true);
            thread.start();
        }
    }

    private void run() {
        try {
            List<Append> group = nextGroup();
            while (!group.isEmpty()) {
                write(group);
                prepareNext();
                group = nextGroup();
            }
        } catch (RuntimeException | Error e) {
            giveUp(e);
        } finally {
            writer.close();
        }
    }

    /** Waits for appends; empty when the journal was closed and all are written. */
    private synchronized List<Append> nextGroup() {
        while (queue.isEmpty() && !closed) {
            try {
                wait();
            } catch (InterruptedException e) {
                LOG.warn("journal {}: the writing thread was interrupted, which is ignored", journal);
            }
        }
        List<Append> group = new ArrayList<>();
        long bytes = 0;
        while (!queue.isEmpty() && bytes < GROUP_BYTES) {
            Append next = queue.poll();
            bytes += next.bytes();
            group.add(next);
        }
        return group;
    }

    private void write(List<Append> group) {
        long[] ends = new long[group.size()];
        Arrays.fill(ends, Long.MAX_VALUE);
        Throwable failed = null;
        try {
            for (int i = 0; i < ends.length; i++) {
                writer.write(group.get(i).payloads(), group.get(i).bytes());
                ends[i] = writer.sequence();
            }
            writer.sync();
        } catch (IOException | RuntimeException | Error e) {
            failed = e;
        }
        long durable = writer.durable();
        JournalException outcome = failed == null ? null : abandon(failed, group);
        done(group, failed, outcome);
        for (int i = 0; i < ends.length; i++) {
            if (ends[i] <= durable) {
                group.get(i).durable().complete(null);
            } else {
                group.get(i).durable().completeExceptionally(outcome);
            }
        }
    }

    /** Without the preallocated file, the next one is created on demand. */
    private void prepareNext() {
        try {
            if (writer.isNextUnprepared()) {
                writer.prepareNext(room.isForSegment());
            }
        } catch (RuntimeException | Error e) {
            LOG.warn("journal {}: the next file cannot be preallocated; it will be created on demand", journal, e);
        }
    }

    /** Stops writing: waiting appends fail, and the task fails at its next poll. */
    private void giveUp(Throwable why) {
        List<Append> unwritten;
        synchronized (this) {
            failure = why;
            unwritten = List.copyOf(queue);
            queue.clear();
            waitingBytes = 0;
            notifyAll();
        }
        unwritten.forEach(append -> append.durable().completeExceptionally(new JournalException.DiskFailed(why)));
    }

    private JournalException abandon(Throwable failed, List<Append> group) {
        writer.abandon();
        long bytes = group.stream().mapToLong(Append::bytes).sum();
        if (failed instanceof IOException && !room.isFree(bytes)) {
            LOG.warn("journal {}: the disk is full", journal, failed);
            return new JournalException.NoRoom(failed);
        }
        LOG.error(
                "journal {}: the disk failed; of {} appends some were not confirmed, the next go into a new file",
                journal,
                group.size(),
                failed);
        return new JournalException.DiskFailed(failed);
    }

    private synchronized void done(List<Append> group, Throwable failed, JournalException outcome) {
        waitingBytes -= group.stream().mapToLong(Append::bytes).sum();
        if (outcome == null) {
            failuresInARow = 0;
        } else if (outcome instanceof JournalException.DiskFailed && ++failuresInARow >= FAILURES_AT_MOST) {
            failure = failed;
        }
        notifyAll();
    }

    /**
     * Waits until a condition that a group can change holds, or until a {@link System#nanoTime}; returns whether it
     * holds.
     */
    synchronized boolean awaitGroup(BooleanSupplier condition, long deadline) throws InterruptedException {
        while (!condition.getAsBoolean()) {
            long left = deadline - System.nanoTime();
            if (left <= 0 || closed) {
                return false;
            }
            wait(left / 1_000_000 + 1);
        }
        return true;
    }

    synchronized void skipTo(long sequence) {
        if (thread != null) {
            throw new IllegalStateException("records were appended already");
        }
        if (sequence > writer.sequence()) {
            writer.skipTo(sequence);
            skippedTo = sequence;
        }
    }

    synchronized long skippedTo() {
        return skippedTo;
    }

    synchronized long waitingBytes() {
        return waitingBytes;
    }

    synchronized Optional<Throwable> failure() {
        return Optional.ofNullable(failure);
    }

    /** Writes the waiting appends and stops; returns whether it did. */
    boolean close() {
        Thread running;
        synchronized (this) {
            closed = true;
            running = thread;
            notifyAll();
        }
        if (running == null) {
            return true;
        }
        boolean interrupted = false;
        long end = System.nanoTime() + CLOSE_WITHIN.toNanos();
        while (running.isAlive() && System.nanoTime() < end) {
            try {
                running.join(Math.max(1, (end - System.nanoTime()) / 1_000_000));
            } catch (InterruptedException e) {
                interrupted = true;
            }
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
        return !running.isAlive();
    }
}
