package io.furrow.fiware.broker;

import java.util.ArrayDeque;
import java.util.Queue;
import java.util.concurrent.Executor;

/** Sends notifications in sequence, each after the answer to the previous one. {@link #offer} never blocks. */
final class NotificationQueue {
    /** Sends and calls back on the answer or failure. */
    interface Sender {
        void send(OutgoingNotification notification, Runnable done);
    }

    private final Executor executor;
    private final Sender sender;
    private final Queue<OutgoingNotification> waiting = new ArrayDeque<>();
    private boolean busy;

    NotificationQueue(Executor executor, Sender sender) {
        this.executor = executor;
        this.sender = sender;
    }

    void offer(OutgoingNotification notification) {
        synchronized (this) {
            waiting.add(notification);
            if (busy) {
                return;
            }
            busy = true;
        }
        executor.execute(this::sendNext);
    }

    private void sendNext() {
        OutgoingNotification next;
        synchronized (this) {
            next = waiting.poll();
            if (next == null) {
                busy = false;
                return;
            }
        }
        sender.send(next, () -> executor.execute(this::sendNext));
    }
}
