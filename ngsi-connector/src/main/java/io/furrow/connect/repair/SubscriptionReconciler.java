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
import java.util.function.LongSupplier;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.GapDetector.Arrived;
import io.furrow.connect.repair.GapDetector.Result;
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

    private final DesiredSubscription desired;
    private final SubscriptionClient client;
    private final BrokerEntities entities;
    private final RepairSettings settings;
    private final SharedServices services;
    private final EntityIdSet known;
    private final Watermark watermark;
    private final LateRecords lateRecords;
    private final GapDetector gapDetector;
    private final BrokerUptime uptime;
    private String subscription = "";
    private Optional<Instant> polledAt = Optional.empty();
    private Optional<String> missing = Optional.empty();
    private Optional<Late> late = Optional.empty();
    private long failedBefore;
    private final ListingSchedule listings;
    private volatile Duration gap = Duration.ZERO;
    private volatile DeliveryReport delivered = DeliveryReport.NOTHING_SENT;

    /** The services that all subscriptions of a task share. */
    public record SharedServices(RecordTracker live, RepairOutput output, Ledger ledger, LongSupplier nanos) {
        public SharedServices(RecordTracker live, RepairOutput output, Ledger ledger) {
            this(live, output, ledger, System::nanoTime);
        }
    }

    /** @throws IOException if the folder for persistent state cannot be used */
    SubscriptionReconciler(
            Function<BrokerRequest, Outcome> broker,
            DesiredSubscription desired,
            RepairSettings settings,
            SharedServices services)
            throws IOException {
        this.desired = desired;
        this.settings = settings;
        this.services = services;
        client = new SubscriptionClient(broker, desired);
        entities = new BrokerEntities(
                broker,
                desired.scope(),
                desired.subject(),
                desired.notificationContent(),
                settings.reading().pageMaxBytes());
        uptime = new BrokerUptime(broker, desired.scope());
        listings = new ListingSchedule(desired.scope(), settings.deletions().interval(), services.nanos());
        gapDetector = new GapDetector(desired.notificationContent().namesItsSubscription());
        Path folder = Files.createDirectories(settings.folder().resolve(folderName(desired.name())));
        known = EntityIdSet.open(folder.resolve("known"), settings.deletions().knownMaxBytes());
        watermark = Watermark.open(folder.resolve("watermark"));
        lateRecords = LateRecords.open(folder.resolve("late"));
        services.live().restoreStale(known.stale());
        watermark.time().ifPresent(time -> services.live().forgetUntil(time.minus(settings.overlap())));
    }

    /** Readable where possible, and unique. */
    private static String folderName(DesiredSubscription.Name name) {
        FiwareScope scope = name.scope();
        String text = (scope.service().isEmpty() ? "-" : scope.service()) + "@" + scope.servicePath() + "@"
                + name.partition().label();
        StringBuilder folder = new StringBuilder();
        for (char sign : text.toCharArray()) {
            boolean plain = sign < 128 && Character.isLetterOrDigit(sign) || "-_@".indexOf(sign) >= 0;
            folder.append(plain ? String.valueOf(sign) : String.format("%%%04x", (int) sign));
        }
        return folder.toString();
    }

    /** An entity of the topic changed or was deleted; from any thread. */
    void note(String identity, boolean gone) throws IOException {
        if (!covers(EntityKeys.scope(identity))) {
            return;
        }
        if (gone) {
            known.remove(identity);
        } else {
            known.add(identity);
        }
    }

    /** One of its entities has to be read again, or all if too many have; from any thread. */
    void markStale(String identity) throws IOException {
        if (covers(EntityKeys.scope(identity)) && !known.markStale(identity)) {
            lateRecords.add(Instant.EPOCH);
        }
    }

    private void markReturned(String identity) throws IOException {
        markStale(identity);
        if (known.isStale(identity)) {
            services.live().restoreStale(List.of(identity));
        }
    }

    /** Changes since a time have to be read again; from any thread. */
    void noteLate(Instant from) throws IOException {
        lateRecords.add(from);
    }

    /** Whether its subscription notifies about entities in the scope. */
    boolean covers(FiwareScope scope) {
        FiwareScope ours = desired.scope();
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
    void poll() throws BrokerException, IOException, InterruptedException {
        Instant now = Clock.systemUTC().instant();
        long failed = services.ledger().rejectedUnavailable.sum()
                + services.ledger().overload.sum();
        long arrived = services.live().arrivedOf(subscription);
        SubscriptionStatus kept = keep(now);
        delivered = kept.report();
        Result result =
                gapDetector.look(kept, new Arrived(arrived, services.live().arrivedOf(kept.id())));
        reasonIn(result).ifPresent(this::miss);
        if (wasRestarted(kept)) {
            miss("the context broker was started again");
        }
        if (failed > failedBefore) {
            miss("the source had to reject notifications");
        }
        late = lateRecords.late();
        if (late.isPresent()) {
            miss("more entities have to be read again than are tracked");
        }
        failedBefore = failed;
        if (missing.isPresent()) {
            listings.demand(result instanceof Result.FirstPoll || kept.state() != SubscriptionStatus.State.AT_WORK);
        }
        Optional<Instant> good = Optional.empty();
        if (settings.mode() == RepairSettings.Mode.OFF) {
            missing = Optional.empty();
            lateRecords.settle(late);
        } else {
            good = repair(kept, result, now);
        }
        known.flush(); // before the watermark, behind which stale entities are not looked for
        // While entities are missing, what was missed before is read again.
        Optional<Instant> reached = unconfirmed().isEmpty() ? good : good.flatMap(time -> watermark.time());
        if (reached.isPresent()) {
            watermark.advanceTo(reached.get(), kept.id());
        }
    }

    /** The address for its notifications. */
    String url() {
        return desired.target().url();
    }

    /** The delivery report of the context broker at the last poll. */
    DeliveryReport delivered() {
        return delivered;
    }

    private SubscriptionStatus keep(Instant now) throws BrokerException {
        try {
            SubscriptionStatus kept = client.keep(now);
            if (!kept.id().equals(subscription)) {
                services.live().follow(subscription, kept.id());
                subscription = kept.id();
            }
            return kept;
        } catch (BrokerException e) {
            if (polledAt.isPresent()) {
                miss("the context broker could not be queried");
            }
            throw e;
        }
    }

    private boolean wasRestarted(SubscriptionStatus kept) {
        Optional<Instant> before = polledAt;
        polledAt = Optional.of(kept.at());
        return before.filter(time -> uptime.isYoungerThan(time, kept.at())).isPresent();
    }

    private Optional<String> reasonIn(Result result) {
        if (result instanceof Result.FirstPoll && missing.isEmpty()) {
            missing = Optional.of("the source has started");
        }
        return result instanceof Result.Missing found ? Optional.of(found.reason()) : Optional.empty();
    }

    /** Only the first reason is logged. */
    private void miss(String reason) {
        if (missing.isEmpty()) {
            services.ledger().gaps.increment();
            missing = Optional.of(reason);
        }
    }

    /** Returns the time up to which nothing is missing any more, if that is known. */
    private Optional<Instant> repair(SubscriptionStatus kept, Result result, Instant now)
            throws BrokerException, IOException, InterruptedException {
        RepairPublisher emission = new RepairPublisher(services.output(), services.live(), known, kept.id());
        Repair repair = new Repair(entities, settings.reading(), services.live(), known, emission);
        long begin = System.nanoTime();
        boolean isMissing = missing.isPresent();
        try {
            if (isMissing) {
                changes(kept, repair, now);
            }
            Set<String> marked = known.stale();
            repair.stale(this::covers);
            if (listings.isNow()) {
                repair.deletions(listings, watermark.time(), this::markReturned);
                listings.done();
            }
            settle(marked);
        } finally {
            services.ledger().repeated.add(repair.result().repeated());
        }
        if (isMissing) {
            report(kept, missing.get(), repair.result(), Duration.ofNanos(System.nanoTime() - begin));
            missing = Optional.empty();
            lateRecords.settle(late);
            // To the second: later notifications of earlier changes concern entities that were read or deleted.
            services.live().forgetUntil(kept.at().plusSeconds(1));
            gapDetector.repaired(services.live().arrivedOf(kept.id()));
            return Optional.of(kept.at());
        }
        return result instanceof Result.Balanced balanced ? Optional.of(balanced.until()) : Optional.empty();
    }

    /**
     * Settles the marked entities that were read again; an entity that became stale meanwhile stays marked across
     * restarts.
     */
    private void settle(Set<String> marked) throws IOException {
        List<String> left = services.live().stale();
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
        boolean isInitial = settings.mode() == RepairSettings.Mode.INITIAL;
        Optional<Instant> missed = good.filter(time -> !isInitial || !watermark.isOfOther(kept.id()))
                .map(time -> time.minus(settings.overlap()))
                .or(() -> isInitial ? Optional.of(Instant.EPOCH) : Optional.empty());
        Optional<Instant> since = Stream.of(missed, late.map(Late::from))
                .flatMap(Optional::stream)
                .min(Comparator.naturalOrder());
        if (since.isPresent()) {
            services.live().forgetUntil(since.get());
            repair.changesFrom(since.get());
        }
    }

    private void report(SubscriptionStatus kept, String reason, Repair.Result result, Duration took) {
        LOG.info(
                "repaired subscription {} of tenant '{}', because {}: a gap of {} s, {} entities changed, {} deleted,"
                        + " {} were known; it took {} ms",
                kept.id(),
                desired.scope().service(),
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
                    desired.scope().service(),
                    settings.deletions().knownMaxBytes());
        }
    }

    /** What the last listing lacked, unless it is trusted, and what to do; empty for nothing. */
    String unconfirmed() {
        return listings.problem();
    }

    FiwareScope scope() {
        return desired.scope();
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
