package io.furrow.connect.source.http;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Iterator;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.journal.RecordLog;

/**
 * Appends records to the intake. While the intake has no room, deliveries wait in the order of their arrival, each
 * until its own deadline. A waiting delivery holds a part of the memory budget for bodies, which bounds the number of
 * waiting deliveries.
 */
public final class AdmissionQueue implements AutoCloseable {
    private static final long RETRY_MS = 10;

    private record Delivery(List<KafkaRecord> records, long deadline, CompletableFuture<Void> durable) {
        boolean isTooLate() {
            return System.nanoTime() - deadline >= 0;
        }
    }

    private final RecordLog recordLog;
    private final Ledger ledger;
    private final Deque<Delivery> waiting = new ArrayDeque<>();
    private final TimeoutQueue timeoutQueue = new TimeoutQueue();
    private final ScheduledExecutorService retries;
    private volatile boolean someWait;
    private boolean closed;

    public AdmissionQueue(RecordLog recordLog, Ledger ledger) {
        this.recordLog = recordLog;
        this.ledger = ledger;
        this.retries = Executors.newSingleThreadScheduledExecutor(task -> {
            Thread thread = new Thread(task, "ngsi-source-hold");
            thread.setDaemon(true);
            return thread;
        });
    }

    /**
     * Completed when the records are durable. Failed with {@link OverloadException} if they are not durable by the
     * deadline, which is a value of {@link System#nanoTime}, with {@link RecordLog.ClosedException}, or with the
     * exception of the intake.
     */
    CompletableFuture<Void> deliver(List<KafkaRecord> records, long deadline) {
        Delivery delivery = new Delivery(records, deadline, new CompletableFuture<>());
        if (someWait || !hand(delivery)) {
            ledger.delayed.increment();
            await(delivery, false);
        }
        if (delivery.durable.isDone()) {
            return delivery.durable;
        }
        CompletableFuture<Void> durable = delivery.durable; // alone: the records must not stay until the next tick
        CompletableFuture<Void> answer = durable.copy();
        // retry() fails waiting deliveries. This watch is for accepted records that are not durable, and fires a little
        // later.
        timeoutQueue.watch(answer, deadline + TimeUnit.MILLISECONDS.toNanos(3 * RETRY_MS), () -> expired(durable));
        return answer;
    }

    /**
     * The reason why the delivery is not durable. A delivery that still waits is removed, even if retry() did not reach
     * it.
     */
    private synchronized OverloadException expired(CompletableFuture<Void> durable) {
        for (Iterator<Delivery> each = waiting.iterator(); each.hasNext(); ) {
            Delivery delivery = each.next();
            if (delivery.durable == durable) {
                each.remove();
                rejectUnavailable(delivery, OverloadException.noRoom());
                return OverloadException.noRoom();
            }
        }
        return OverloadException.late();
    }

    /** Whether the delivery need not wait: the intake had room or failed. */
    private boolean hand(Delivery delivery) {
        try {
            Optional<CompletableFuture<Void>> taken = recordLog.take(delivery.records);
            taken.ifPresent(durable -> durable.whenComplete((nothing, failure) -> settle(delivery, failure)));
            return taken.isPresent();
        } catch (RuntimeException | Error e) {
            rejectUnavailable(delivery, e);
            return true;
        }
    }

    /** Late records are counted when the intake reports them, which may be after the answer. */
    private void settle(Delivery delivery, Throwable failure) {
        Throwable cause = failure instanceof CompletionException ? failure.getCause() : failure;
        if (cause == null) {
            delivery.durable.complete(null);
        } else if (cause instanceof RecordLog.NoRoomException && !delivery.isTooLate()) {
            await(delivery, true);
        } else {
            rejectUnavailable(
                    delivery, cause instanceof RecordLog.NoRoomException ? OverloadException.noRoom() : cause);
        }
    }

    private void rejectUnavailable(Delivery delivery, Throwable cause) {
        ledger.rejectedUnavailable.add(delivery.records.size());
        delivery.durable.completeExceptionally(cause);
    }

    private synchronized void await(Delivery delivery, boolean first) {
        if (closed) {
            rejectUnavailable(delivery, new RecordLog.ClosedException());
            return;
        }
        if (first) {
            waiting.addFirst(delivery);
        } else {
            waiting.addLast(delivery);
        }
        if (!someWait) {
            someWait = true;
            retries.schedule(this::retry, RETRY_MS, TimeUnit.MILLISECONDS);
        }
    }

    private synchronized void retry() {
        try {
            while (!waiting.isEmpty()) {
                Delivery first = waiting.remove();
                if (first.isTooLate()) {
                    rejectUnavailable(first, OverloadException.noRoom());
                } else if (!hand(first)) {
                    waiting.addFirst(first);
                    break;
                }
            }
        } finally {
            someWait = !waiting.isEmpty();
            if (someWait) {
                retries.schedule(this::retry, RETRY_MS, TimeUnit.MILLISECONDS);
            }
        }
    }

    /** Fails all waiting deliveries and accepts no more. */
    @Override
    public synchronized void close() {
        closed = true;
        retries.shutdownNow();
        waiting.forEach(each -> rejectUnavailable(each, new RecordLog.ClosedException()));
        waiting.clear();
    }
}
