package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;
import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.SubscriptionReconciler.SharedServices;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.text.FailureText;

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
        private final SubscriptionReconciler caretaker;
        private long due = System.nanoTime();
        private Duration pause = Duration.ZERO;
        private volatile boolean failing;
        private volatile boolean done;
        private volatile String problem = "";

        private Schedule(SubscriptionReconciler caretaker) {
            this.caretaker = caretaker;
        }
    }

    private final List<Schedule> charges = new ArrayList<>();
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
            List<Assignment> commissions,
            RepairSettings settings,
            SharedServices means,
            Duration interval)
            throws IOException {
        ReconcileLoop caretakers = new ReconcileLoop(interval);
        try {
            for (Assignment commission : commissions) {
                caretakers.charges.add(new Schedule(commission.caretaker(broker, settings, means)));
            }
        } catch (IOException e) {
            caretakers.close();
            throw e;
        }
        means.live().onStale(caretakers::markStale);
        means.live().onOverflow(caretakers::noteLate);
        caretakers.show(means.ledger());
        caretakers.thread.start();
        return caretakers;
    }

    /** A desired subscription in a scope, whose service path may end in {@code /#}. */
    public record Assignment(FiwareScope scope, DesiredSubscription desired) {
        private SubscriptionReconciler caretaker(
                Function<BrokerRequest, Outcome> broker, RepairSettings settings, SharedServices means)
                throws IOException {
            return SubscriptionReconciler.open(
                    SubscriptionReconciler.Target.of(
                            broker, scope, desired, settings.reading().pageMaxBytes()),
                    settings,
                    means);
        }
    }

    private ReconcileLoop(Duration interval) {
        this.interval = interval;
        thread = new Thread(this::run, "furrow-reconcile");
        thread.setDaemon(true);
    }

    private void show(Ledger ledger) {
        ledger.gauge(
                "subscriptionsKept",
                "Subscriptions in the desired state, as of the last poll",
                () -> charges.stream()
                        .filter(each -> each.done && !each.failing)
                        .count());
        ledger.gauge(
                "subscriptionsUnkept",
                "Subscriptions that cannot be managed now: the context broker is unavailable or rejects requests",
                () -> charges.stream().filter(each -> each.failing).count());
        ledger.gauge(
                "lastGapMillis",
                "Milliseconds from the last time known good to the last repair",
                () -> charges.stream()
                        .mapToLong(each -> each.caretaker.lastGap().toMillis())
                        .max()
                        .orElse(0));
        ledger.gauge(
                "knownEntities",
                "Entities whose deletion can be found",
                () -> charges.stream()
                        .mapToLong(each -> each.caretaker.knownEntities())
                        .sum());
        ledger.detail("subscriptions", this::details);
    }

    private JsonNode details() {
        ArrayNode details = JsonNodeFactory.instance.arrayNode();
        for (Schedule charge : charges) {
            ObjectNode detail = details.addObject()
                    .put("tenant", charge.caretaker.scope().service())
                    .put("servicePath", charge.caretaker.scope().servicePath());
            if (charge.failing) {
                detail.put("problem", charge.problem);
            }
            detail.put("url", charge.caretaker.url());
            detail.put("failsInARow", charge.caretaker.delivered().failsInARow());
        }
        return details;
    }

    /** An entity of the topic changed or was deleted. */
    public void note(String identity, boolean gone) {
        for (Schedule charge : charges) {
            try {
                charge.caretaker.note(identity, gone);
            } catch (IOException | RuntimeException e) {
                // The next poll fails for the same reason, and logs it.
                LOG.debug("cannot note {}", LogText.oneLine(identity), e);
            }
        }
    }

    private void markStale(String identity) {
        for (Schedule charge : charges) {
            try {
                charge.caretaker.markStale(identity);
            } catch (IOException | RuntimeException e) {
                // The next poll fails for the same reason, and logs it.
                LOG.debug("cannot note {}", LogText.oneLine(identity), e);
            }
        }
    }

    /** Each of them reads again: whose entities they are was not tracked. */
    private void noteLate(Instant from) {
        for (Schedule charge : charges) {
            try {
                charge.caretaker.noteLate(from);
            } catch (IOException | RuntimeException e) {
                LOG.warn(
                        "cannot store from when entities of {} have to be read again; a restart would forget it",
                        charge.caretaker.scope(),
                        e);
            }
        }
    }

    /** Whether one of the subscriptions notifies about entities in the scope. */
    public boolean covers(FiwareScope scope) {
        return charges.stream().anyMatch(charge -> charge.caretaker.covers(scope));
    }

    private void run() {
        try {
            while (!closed) {
                long now = System.nanoTime();
                for (Schedule charge : charges) {
                    if (charge.due - now <= 0 && !closed && !resting) {
                        look(charge);
                    }
                }
                long next = charges.stream()
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
    private void look(Schedule charge) throws InterruptedException {
        Duration asked = Duration.ZERO;
        try {
            charge.caretaker.look();
            succeeded(charge);
        } catch (BrokerException e) {
            asked = e.retryAfter().orElse(Duration.ZERO);
            failed(charge, e);
        } catch (IOException | RuntimeException | Error e) {
            failed(charge, e);
        }
        if (Thread.interrupted()) {
            throw new InterruptedException("stopped");
        }
        Duration wait = charge.failing ? charge.pause : interval;
        charge.due = System.nanoTime() + (asked.compareTo(wait) > 0 ? asked : wait).toNanos();
    }

    private void succeeded(Schedule charge) {
        if (charge.failing) {
            LOG.info("subscription of {} is managed again", charge.caretaker.scope());
        }
        charge.failing = false;
        charge.done = true;
        charge.pause = Duration.ZERO;
    }

    private void failed(Schedule charge, Throwable why) {
        if (closed) {
            return;
        }
        boolean known = charge.failing;
        charge.failing = true;
        charge.problem = FailureText.of(why);
        Duration twice = charge.pause.isZero() ? FIRST_PAUSE : charge.pause.multipliedBy(2);
        charge.pause = twice.compareTo(MAX_PAUSE) > 0 ? MAX_PAUSE : twice;
        if (!known) {
            LOG.warn(
                    "subscription of {} cannot be managed: {}; the source continues to accept notifications and"
                            + " retries; check context.broker.url and the subscription.* options",
                    charge.caretaker.scope(),
                    charge.problem,
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
        for (Schedule charge : charges) {
            try {
                charge.caretaker.close();
            } catch (IOException e) {
                LOG.warn("cannot close the known entities of {}", charge.caretaker.scope(), e);
            }
        }
    }
}
