package io.furrow.simulators.fiware;

import java.util.ArrayDeque;
import java.util.Queue;
import java.util.concurrent.Executor;

/** Notifications that are sent one after the other, each when the one before it was answered. Never blocks who offers. */
final class Lane {
    /** Sends and calls back when the answer or the failure is there. */
    interface Sender {
        void send(Notification notification, Runnable done);
    }

    private final Executor executor;
    private final Sender sender;
    private final Queue<Notification> waiting = new ArrayDeque<>();
    private boolean busy;

    Lane(Executor executor, Sender sender) {
        this.executor = executor;
        this.sender = sender;
    }

    void offer(Notification notification) {
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
        Notification next;
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
