package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.DeliveryBalance.Arrived;
import io.furrow.connect.repair.DeliveryBalance.Verdict;
import io.furrow.connect.repair.LateRecords.Late;
import io.furrow.connect.subscription.DeliveryReport;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.connect.subscription.SubscriptionClient;
import io.furrow.connect.subscription.SubscriptionStatus;
import io.furrow.model.event.FiwareScope;

/**
 * Reconciles one subscription, poll by poll: restores its desired state, compares sent with arrived notifications, and
 * reads changes that may have been missed from the context broker. Not thread-safe, except for the notes on single
 * events.
 */
public final class SubscriptionReconciler implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(SubscriptionReconciler.class);

    private final SubscriptionClient keeper;
    private final BrokerEntities entities;
    private final RepairSettings settings;
    private final SharedServices means;
    private final KnownEntities known;
    private final Watermark watermark;
    private final LateRecords lateRecords;
    private final DeliveryBalance balance;
    private final BrokerUptime uptime;
    private String subscription = "";
    private Optional<Instant> lookedAt = Optional.empty();
    private Optional<String> missing = Optional.empty();
    private Optional<Late> late = Optional.empty();
    private long turnedAway;
    private final ListingSchedule listings;
    private volatile Duration gap = Duration.ZERO;
    private volatile DeliveryReport delivered = DeliveryReport.NOTHING_SENT;

    /** The subscription and its entities. */
    record Target(SubscriptionClient keeper, BrokerEntities entities, BrokerUptime uptime) {
        /** @param maxBytes of a page's body */
        static Target of(
                Function<BrokerRequest, Outcome> broker,
                FiwareScope scope,
                DesiredSubscription desired,
                long maxBytes) {
            return new Target(
                    new SubscriptionClient(broker, scope, desired),
                    new BrokerEntities(broker, scope, desired.subject(), desired.content(), maxBytes),
                    new BrokerUptime(broker, scope));
        }
    }

    /** The services that all subscriptions of a task share. */
    public record SharedServices(LiveEvents live, RepairOutput output, Ledger ledger) {}

    private SubscriptionReconciler(Target charge, RepairSettings settings, SharedServices means, Path folder)
            throws IOException {
        keeper = charge.keeper();
        entities = charge.entities();
        uptime = charge.uptime();
        listings = new ListingSchedule(settings.deletions().interval());
        this.settings = settings;
        this.means = means;
        balance = new DeliveryBalance(keeper.desired().content().namesItsSubscription());
        known = KnownEntities.open(folder.resolve("known"), settings.deletions().knownMaxBytes());
        watermark = Watermark.open(folder.resolve("watermark"));
        lateRecords = LateRecords.open(folder.resolve("late"));
        means.live().restoreStale(known.stale());
        watermark.time().ifPresent(time -> means.live().forgetUntil(time.minus(settings.overlap())));
    }

    /**
     * @throws IOException if the folder cannot be used
     */
    static SubscriptionReconciler open(Target charge, RepairSettings settings, SharedServices means)
            throws IOException {
        String share = charge.keeper().desired().name().share().label();
        Path folder = settings.folder().resolve(folderName(charge.keeper().scope(), share));
        Files.createDirectories(folder);
        return new SubscriptionReconciler(charge, settings, means, folder);
    }

    /** Readable where possible, and unique. */
    private static String folderName(FiwareScope scope, String share) {
        String text = (scope.service().isEmpty() ? "-" : scope.service()) + "@" + scope.servicePath() + "@" + share;
        StringBuilder name = new StringBuilder();
        for (char sign : text.toCharArray()) {
            boolean plain = sign < 128 && Character.isLetterOrDigit(sign) || "-_@".indexOf(sign) >= 0;
            name.append(plain ? String.valueOf(sign) : String.format("%%%04x", (int) sign));
        }
        return name.toString();
    }

    /** An entity of the topic changed or was deleted; from any thread. */
    void note(String identity, boolean gone) throws IOException {
        if (!covers(Identities.scope(identity))) {
            return;
        }
        if (gone) {
            known.remove(identity);
        } else {
            known.add(identity);
        }
    }

    /** One of its entities has to be read again; from any thread. */
    void markStale(String identity) throws IOException {
        if (covers(Identities.scope(identity))) {
            known.markStale(identity);
        }
    }

    /** What changed since a time has to be read again; from any thread. */
    void noteLate(Instant from) throws IOException {
        lateRecords.add(from);
    }

    /** Whether its subscription notifies about entities in the scope. */
    boolean covers(FiwareScope scope) {
        FiwareScope ours = keeper.scope();
        if (!ours.service().equals(scope.service())) {
            return false;
        }
        String path = ours.servicePath();
        return path.endsWith("/#")
                ? (scope.servicePath() + "/").startsWith(path.substring(0, path.length() - 1))
                : path.equals(scope.servicePath());
    }

    /**
     * Polls the subscription, and repairs if necessary. Work that a failure interrupts is done at the next poll.
     *
     * @throws BrokerException if the context broker is unavailable or rejects a request
     * @throws IOException if persistent state cannot be written, or the source accepts no more records
     */
    void look() throws BrokerException, IOException, InterruptedException {
        Instant now = Clock.systemUTC().instant();
        long failed = means.ledger().turnedAway.sum() + means.ledger().overload.sum();
        long arrived = means.live().arrivedOf(subscription);
        SubscriptionStatus kept = keep(now);
        delivered = kept.report();
        Verdict verdict = balance.look(kept, new Arrived(arrived, means.live().arrivedOf(kept.id())));
        reasonIn(verdict).ifPresent(this::miss);
        if (wasRestarted(kept)) {
            miss("the context broker was started again");
        }
        if (failed > turnedAway) {
            miss("the source had to reject notifications");
        }
        late = lateRecords.late();
        if (late.isPresent()) {
            miss("more notifications were late than repair.recent.max.bytes can track");
        }
        turnedAway = failed;
        if (missing.isPresent()) {
            listings.demand(verdict instanceof Verdict.First || kept.state() != SubscriptionStatus.State.AT_WORK);
        }
        if (settings.mode() == RepairSettings.Mode.OFF) {
            missing = Optional.empty();
            lateRecords.settle(late);
        } else {
            repair(kept, verdict, now);
        }
        known.flush();
    }

    /** Where its notifications go. */
    String url() {
        return keeper.desired().target().url();
    }

    /** What the context broker said about its notifications at the last poll. */
    DeliveryReport delivered() {
        return delivered;
    }

    private SubscriptionStatus keep(Instant now) throws BrokerException {
        try {
            SubscriptionStatus kept = keeper.keep(now);
            if (!kept.id().equals(subscription)) {
                means.live().follow(subscription, kept.id());
                subscription = kept.id();
            }
            return kept;
        } catch (BrokerException e) {
            if (lookedAt.isPresent()) {
                miss("the context broker could not be queried");
            }
            throw e;
        }
    }

    private boolean wasRestarted(SubscriptionStatus kept) {
        Optional<Instant> before = lookedAt;
        lookedAt = Optional.of(kept.at());
        return before.filter(time -> uptime.isYoungerThan(time, kept.at())).isPresent();
    }

    private Optional<String> reasonIn(Verdict verdict) {
        if (verdict instanceof Verdict.First && missing.isEmpty()) {
            missing = Optional.of("the source has started");
        }
        return verdict instanceof Verdict.Missing found ? Optional.of(found.reason()) : Optional.empty();
    }

    /** The first reason is the one that is logged. */
    private void miss(String reason) {
        if (missing.isEmpty()) {
            means.ledger().gaps.increment();
            missing = Optional.of(reason);
        }
    }

    private void repair(SubscriptionStatus kept, Verdict verdict, Instant now)
            throws BrokerException, IOException, InterruptedException {
        RepairPublisher emission = new RepairPublisher(means.output(), means.live(), known, kept.id());
        Repair repair = new Repair(entities, settings.reading(), means.live(), known, emission);
        long begin = System.nanoTime();
        boolean isMissing = missing.isPresent();
        try {
            if (isMissing) {
                changes(kept, repair, now);
            }
            Set<String> marked = known.stale();
            repair.stale(this::covers);
            if (listings.isNow()) {
                repair.deletions();
                listings.done();
            }
            settle(marked);
        } finally {
            means.ledger().repeated.add(repair.result().repeated());
        }
        if (isMissing) {
            report(kept, missing.get(), repair.result(), Duration.ofNanos(System.nanoTime() - begin));
            missing = Optional.empty();
            lateRecords.settle(late);
            // To the second: later notifications of earlier changes concern entities that were read or deleted.
            means.live().forgetUntil(kept.at().plusSeconds(1));
            balance.repaired(means.live().arrivedOf(kept.id()));
            watermark.advanceTo(kept.at());
        } else if (verdict instanceof Verdict.Balanced balanced) {
            watermark.advanceTo(balanced.until());
        }
    }

    /**
     * Settles the marked entities that were read again; an entity that became stale meanwhile stays marked across
     * restarts.
     */
    private void settle(Set<String> marked) throws IOException {
        List<String> left = means.live().stale();
        for (String identity : left) {
            markStale(identity);
        }
        marked.removeAll(left);
        known.settle(marked);
    }

    private void changes(SubscriptionStatus kept, Repair repair, Instant now)
            throws BrokerException, IOException, InterruptedException {
        Optional<Instant> good = watermark.time().or(() -> LastNotification.of(kept));
        gap = good.map(time -> Duration.between(time, now)).orElse(Duration.ZERO);
        Optional<Instant> missed = good.map(time -> time.minus(settings.overlap()))
                .or(() ->
                        settings.mode() == RepairSettings.Mode.INITIAL ? Optional.of(Instant.EPOCH) : Optional.empty());
        Optional<Instant> since = Stream.of(missed, late.map(Late::from))
                .flatMap(Optional::stream)
                .min(Comparator.naturalOrder());
        if (since.isPresent()) {
            means.live().forgetUntil(since.get());
            repair.changesFrom(since.get());
        }
    }

    private void report(SubscriptionStatus kept, String reason, Repair.Result result, Duration took) {
        LOG.info(
                "repaired subscription {} of tenant '{}', because {}: a gap of {} s, {} entities changed, {} deleted,"
                        + " {} were known; it took {} ms",
                kept.id(),
                keeper.scope().service(),
                reason,
                gap.toSeconds(),
                result.changed(),
                result.deleted(),
                result.repeated(),
                took.toMillis());
        if (known.isOverfull()) {
            LOG.warn(
                    "tenant '{}' has more entities than {} bytes hold: deletions that were not notified are not found;"
                            + " raise repair.known.max.bytes if there is memory",
                    keeper.scope().service(),
                    settings.deletions().knownMaxBytes());
        }
    }

    FiwareScope scope() {
        return keeper.scope();
    }

    /** The time between the last known good time and the last repair. */
    Duration lastGap() {
        return gap;
    }

    int knownEntities() {
        return known.size();
    }

    @Override
    public void close() throws IOException {
        known.close();
    }
}
