package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Duration;
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
import io.furrow.connect.repair.Caretaker.Means;
import io.furrow.connect.subscription.WantedSubscription;
import io.furrow.model.event.FiwareScope;

/**
 * Takes care of all subscriptions of a task, on a thread of its own. A context broker that is away or refuses is tried again,
 * with longer and longer pauses, and said once; nobody else waits for it.
 */
public final class Caretakers implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Caretakers.class);

    private static final Duration FIRST_PAUSE = Duration.ofSeconds(1);
    private static final Duration LONGEST_PAUSE = Duration.ofSeconds(30);
    private static final Duration STOP_PATIENCE = Duration.ofSeconds(1);
    private static final long REST_MILLIS = 200;

    private static final class Charge {
        private final Caretaker caretaker;
        private long due = System.nanoTime();
        private Duration pause = Duration.ZERO;
        private volatile boolean failing;
        private volatile boolean done;
        private volatile String problem = "";

        private Charge(Caretaker caretaker) {
            this.caretaker = caretaker;
        }
    }

    private final List<Charge> charges = new ArrayList<>();
    private final Duration interval;
    private final Thread thread;
    private volatile boolean closed;
    private volatile boolean resting;

    /**
     * @param broker takes a request and waits for what becomes of it
     * @throws IOException if the folder of what outlives a restart cannot be used
     */
    public static Caretakers start(
            Function<BrokerRequest, Outcome> broker,
            List<Commission> commissions,
            RepairSettings settings,
            Means means,
            Duration interval)
            throws IOException {
        Caretakers caretakers = new Caretakers(interval);
        try {
            for (Commission commission : commissions) {
                caretakers.charges.add(new Charge(commission.caretaker(broker, settings, means)));
            }
        } catch (IOException e) {
            caretakers.close();
            throw e;
        }
        means.live().onStale(caretakers::markStale);
        caretakers.show(means.ledger());
        caretakers.thread.start();
        return caretakers;
    }

    /** A subscription that is wanted in a scope, whose service path may end in {@code /#}. */
    public record Commission(FiwareScope scope, WantedSubscription wanted) {
        private Caretaker caretaker(Function<BrokerRequest, Outcome> broker, RepairSettings settings, Means means)
                throws IOException {
            return Caretaker.open(
                    Caretaker.Charge.of(
                            broker, scope, wanted, settings.reading().pageMaxBytes()),
                    settings,
                    means);
        }
    }

    private Caretakers(Duration interval) {
        this.interval = interval;
        thread = new Thread(this::run, "furrow-caretaker");
        thread.setDaemon(true);
    }

    private void show(Ledger ledger) {
        ledger.gauge(
                "subscriptionsKept",
                "Subscriptions that are as they should be, as of the last look",
                () -> charges.stream()
                        .filter(each -> each.done && !each.failing)
                        .count());
        ledger.gauge(
                "subscriptionsUnkept",
                "Subscriptions that cannot be kept now: the context broker is away or refuses",
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
        for (Charge charge : charges) {
            ObjectNode detail = details.addObject()
                    .put("tenant", charge.caretaker.scope().service())
                    .put("servicePath", charge.caretaker.scope().servicePath());
            if (charge.failing) {
                detail.put("problem", charge.problem);
            }
        }
        return details;
    }

    /** An entity of the topic changed, or is gone. */
    public void note(FiwareScope scope, String entityId, boolean gone) {
        String identity = scope.identity(entityId);
        for (Charge charge : charges) {
            try {
                charge.caretaker.note(scope, identity, gone);
            } catch (IOException | RuntimeException e) {
                // The next look fails for the same reason, and says so.
                LOG.debug("cannot note {}", LogText.oneLine(identity), e);
            }
        }
    }

    private void markStale(String identity) {
        for (Charge charge : charges) {
            try {
                charge.caretaker.markStale(identity);
            } catch (IOException | RuntimeException e) {
                // The next look fails for the same reason, and says so.
                LOG.debug("cannot note {}", LogText.oneLine(identity), e);
            }
        }
    }

    /** Whether one of the subscriptions tells of entities there. */
    public boolean covers(FiwareScope scope) {
        return charges.stream().anyMatch(charge -> charge.caretaker.covers(scope));
    }

    private void run() {
        try {
            while (!closed) {
                long now = System.nanoTime();
                for (Charge charge : charges) {
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
            LOG.debug("stopped while it looked after subscriptions", e);
        }
    }

    /** Whatever goes wrong, the next look is made: nothing else would notice that this thread has ended. */
    private void look(Charge charge) throws InterruptedException {
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

    private void succeeded(Charge charge) {
        if (charge.failing) {
            LOG.info("subscription of {} is kept again", charge.caretaker.scope());
        }
        charge.failing = false;
        charge.done = true;
        charge.pause = Duration.ZERO;
    }

    private void failed(Charge charge, Throwable why) {
        if (closed) {
            return;
        }
        boolean known = charge.failing;
        charge.failing = true;
        charge.problem = why instanceof BrokerException ? why.getMessage() : why.toString();
        Duration twice = charge.pause.isZero() ? FIRST_PAUSE : charge.pause.multipliedBy(2);
        charge.pause = twice.compareTo(LONGEST_PAUSE) > 0 ? LONGEST_PAUSE : twice;
        if (!known) {
            LOG.warn(
                    "subscription of {} cannot be kept: {}; the source goes on taking notifications and tries again;"
                            + " see that context.broker.url and the subscription.* options fit the context broker",
                    charge.caretaker.scope(),
                    charge.problem,
                    why);
        }
    }

    /** Whether nothing new is asked of the context broker for now; what changes is noted all the same. */
    public void rest(boolean now) {
        resting = now;
    }

    /** Ends what is under way, within a second. */
    @Override
    public void close() {
        closed = true;
        thread.interrupt();
        try {
            thread.join(STOP_PATIENCE.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        for (Charge charge : charges) {
            try {
                charge.caretaker.close();
            } catch (IOException e) {
                LOG.warn("cannot close what is known of {}", charge.caretaker.scope(), e);
            }
        }
    }
}
