package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerBackoff;
import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.SubscriptionReconciler.SharedServices;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.text.FailureText;
import io.furrow.model.text.LogText;

/**
 * Manages all subscriptions of a task on its own thread. Requests that fail because the context broker is unavailable
 * or rejects them are retried with increasing pauses and logged once; other threads do not wait.
 */
public final class ReconcileLoop implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ReconcileLoop.class);

    private static final Duration FIRST_PAUSE = Duration.ofSeconds(1);
    private static final Duration MAX_PAUSE = Duration.ofSeconds(30);
    private static final Duration STOP_TIMEOUT = Duration.ofSeconds(1);
    private static final long REST_MILLIS = 200;

    private static final class Schedule {
        private final SubscriptionReconciler reconciler;
        private long due = System.nanoTime();
        private final BrokerBackoff backoff = new BrokerBackoff(FIRST_PAUSE, MAX_PAUSE);
        private volatile boolean failing;
        private volatile boolean done;
        private volatile String problem = "";

        private Schedule(SubscriptionReconciler reconciler) {
            this.reconciler = reconciler;
        }
    }

    private final List<Schedule> schedules = new ArrayList<>();
    private final Duration interval;
    private final Thread thread;
    private volatile boolean closed;
    private volatile boolean resting;

    /**
     * @param broker sends a request and waits for its outcome
     * @throws IOException if the folder for persistent state cannot be used
     */
    public static ReconcileLoop start(
            Function<BrokerRequest, Outcome> broker,
            List<DesiredSubscription> subscriptions,
            RepairSettings settings,
            SharedServices services,
            Duration interval)
            throws IOException {
        ReconcileLoop loop = new ReconcileLoop(interval);
        try {
            for (DesiredSubscription desired : subscriptions) {
                loop.schedules.add(new Schedule(new SubscriptionReconciler(broker, desired, settings, services)));
            }
        } catch (IOException e) {
            loop.close();
            throw e;
        }
        services.live().onStale(loop::markStale);
        services.live().onOverflow(loop::noteLate);
        loop.show(services.ledger());
        loop.thread.start();
        return loop;
    }

    private ReconcileLoop(Duration interval) {
        this.interval = interval;
        thread = new Thread(this::run, "furrow-reconcile");
        thread.setDaemon(true);
    }

    private void show(Ledger ledger) {
        ledger.gauge(
                "subscriptionsInSync",
                "Subscriptions in the desired state, as of the last poll",
                () -> schedules.stream()
                        .filter(each -> each.done && !each.failing)
                        .count());
        ledger.gauge(
                "subscriptionsOutOfSync",
                "Subscriptions that cannot be managed now: the context broker is unavailable or rejects requests",
                () -> schedules.stream().filter(each -> each.failing).count());
        ledger.gauge(
                "lastGapMillis",
                "Milliseconds from the last time known good to the last repair",
                () -> schedules.stream()
                        .mapToLong(each -> each.reconciler.lastGap().toMillis())
                        .max()
                        .orElse(0));
        ledger.gauge(
                "knownEntities",
                "Entities whose deletion can be found",
                () -> schedules.stream()
                        .mapToLong(each -> each.reconciler.knownEntities())
                        .sum());
        ledger.detail("subscriptions", this::details);
    }

    private JsonNode details() {
        ArrayNode details = JsonNodeFactory.instance.arrayNode();
        for (Schedule schedule : schedules) {
            ObjectNode detail = details.addObject()
                    .put("tenant", schedule.reconciler.scope().service())
                    .put("servicePath", schedule.reconciler.scope().servicePath());
            String problem = schedule.failing ? schedule.problem : schedule.reconciler.unconfirmed();
            if (!problem.isEmpty()) {
                detail.put("problem", problem);
            }
            detail.put("url", schedule.reconciler.url());
            detail.put("failsInARow", schedule.reconciler.delivered().failsInARow());
        }
        return details;
    }

    private interface Note {
        void to(SubscriptionReconciler reconciler) throws IOException;
    }

    /** An entity of the topic changed or was deleted. */
    public void note(String identity, boolean gone) {
        note(identity, reconciler -> reconciler.note(identity, gone));
    }

    private void markStale(String identity) {
        note(identity, reconciler -> reconciler.markStale(identity));
    }

    private void note(String identity, Note note) {
        for (Schedule schedule : schedules) {
            try {
                note.to(schedule.reconciler);
            } catch (IOException | RuntimeException e) {
                // The next poll fails for the same reason, and logs it.
                LOG.debug("cannot note {}", LogText.oneLine(identity), e);
            }
        }
    }

    /** Each of them reads again: whose entities they are was not tracked. */
    private void noteLate(Instant from) {
        for (Schedule schedule : schedules) {
            try {
                schedule.reconciler.noteLate(from);
            } catch (IOException | RuntimeException e) {
                LOG.warn(
                        "cannot store since when entities of {} have to be read again; a restart would lose it",
                        schedule.reconciler.scope(),
                        e);
            }
        }
    }

    /** Whether one of the subscriptions notifies about entities in the scope. */
    public boolean covers(FiwareScope scope) {
        return schedules.stream().anyMatch(schedule -> schedule.reconciler.covers(scope));
    }

    private void run() {
        try {
            while (!closed) {
                long now = System.nanoTime();
                for (Schedule schedule : schedules) {
                    if (schedule.due - now <= 0 && !closed && !resting) {
                        poll(schedule);
                    }
                }
                long next = schedules.stream()
                        .mapToLong(each -> each.due - System.nanoTime())
                        .min()
                        .orElse(0);
                Thread.sleep(Math.max(
                        resting ? REST_MILLIS : 1, Duration.ofNanos(next).toMillis()));
            }
        } catch (InterruptedException e) {
            LOG.debug("stopped while polling subscriptions", e);
        }
    }

    /** Catches every failure so that the next poll runs: nothing else would notice the end of this thread. */
    private void poll(Schedule schedule) throws InterruptedException {
        Duration wait = interval;
        try {
            schedule.reconciler.poll();
            succeeded(schedule);
        } catch (BrokerException e) {
            failed(schedule, e);
            wait = schedule.backoff.after(e.retryAfter());
        } catch (IOException | RuntimeException | Error e) {
            failed(schedule, e);
            wait = schedule.backoff.after(Optional.empty());
        }
        if (Thread.interrupted()) {
            throw new InterruptedException("stopped");
        }
        schedule.due = System.nanoTime() + wait.toNanos();
    }

    private void succeeded(Schedule schedule) {
        if (schedule.failing) {
            LOG.info("subscription of {} is managed again", schedule.reconciler.scope());
        }
        schedule.failing = false;
        schedule.done = true;
        schedule.backoff.reset();
    }

    private void failed(Schedule schedule, Throwable why) {
        if (closed) {
            return;
        }
        boolean known = schedule.failing;
        schedule.failing = true;
        schedule.problem = FailureText.of(why);
        if (!known) {
            LOG.warn(
                    "subscription of {} cannot be managed: {}; the source continues to accept notifications and"
                            + " retries; check context.broker.url and the subscription.* options",
                    schedule.reconciler.scope(),
                    schedule.problem,
                    why);
        }
    }

    /** Pauses requests to the context broker; changes are still tracked. */
    public void rest(boolean now) {
        resting = now;
    }

    /** Stops the current work within a second. */
    @Override
    public void close() {
        closed = true;
        thread.interrupt();
        try {
            thread.join(STOP_TIMEOUT.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        for (Schedule schedule : schedules) {
            try {
                schedule.reconciler.close();
            } catch (IOException e) {
                LOG.warn("cannot close the known entities of {}", schedule.reconciler.scope(), e);
            }
        }
    }
}
