package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.util.Optional;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.DeliveryBalance.Verdict;
import io.furrow.connect.subscription.Kept;
import io.furrow.connect.subscription.SubscriptionKeeper;
import io.furrow.model.event.FiwareScope;

/**
 * Takes care of one subscription, look by look: keeps it as it should be, holds what was sent against what came, and reads from
 * the context broker what may have been missed. Used by one thread, but for the notes on single events.
 */
public final class Caretaker implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Caretaker.class);

    private final SubscriptionKeeper keeper;
    private final BrokerEntities entities;
    private final RepairSettings settings;
    private final Means means;
    private final KnownEntities known;
    private final Watermark watermark;
    private final DeliveryBalance balance;
    private Optional<String> missing = Optional.empty();
    private long turnedAway;
    private volatile Duration gap = Duration.ZERO;

    /** What all of a task share. */
    public record Means(LiveEvents live, RepairOutput output, Ledger ledger) {}

    private Caretaker(
            SubscriptionKeeper keeper, BrokerEntities entities, RepairSettings settings, Means means, Path folder)
            throws IOException {
        this.keeper = keeper;
        this.entities = entities;
        this.settings = settings;
        this.means = means;
        balance = new DeliveryBalance(keeper.wanted().content().namesItsSubscription());
        known = KnownEntities.open(folder.resolve("known"), settings.mostKnown());
        watermark = Watermark.open(folder.resolve("watermark"));
    }

    /**
     * @throws IOException if the folder cannot be used
     */
    static Caretaker open(SubscriptionKeeper keeper, BrokerEntities entities, RepairSettings settings, Means means)
            throws IOException {
        String share = keeper.wanted().name().share().label();
        Path folder = settings.folder().resolve(folderName(keeper.scope(), share));
        Files.createDirectories(folder);
        return new Caretaker(keeper, entities, settings, means, folder);
    }

    /** Readable where it can be, and the same for no two. */
    private static String folderName(FiwareScope scope, String share) {
        String text = (scope.service().isEmpty() ? "-" : scope.service()) + "@" + scope.servicePath() + "@" + share;
        StringBuilder name = new StringBuilder();
        for (char sign : text.toCharArray()) {
            boolean plain = sign < 128 && Character.isLetterOrDigit(sign) || "-_@".indexOf(sign) >= 0;
            name.append(plain ? String.valueOf(sign) : String.format("%%%04x", (int) sign));
        }
        return name.toString();
    }

    /** An entity of the topic changed, or is gone; from any thread. */
    void note(FiwareScope scope, String identity, boolean gone) throws IOException {
        if (!covers(scope)) {
            return;
        }
        if (gone) {
            known.remove(identity);
        } else {
            known.add(identity);
        }
    }

    private boolean covers(FiwareScope scope) {
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
     * One look, and a repair where it is needed. What a failure leaves undone is done at the next look.
     *
     * @throws BrokerException if the context broker is away or refuses
     * @throws IOException if what outlives a restart cannot be written, or the source takes nothing more
     */
    void look() throws BrokerException, IOException, InterruptedException {
        Instant now = Clock.systemUTC().instant();
        long failed = means.ledger().turnedAway.sum() + means.ledger().overload.sum();
        Kept kept = keeper.keep(now);
        Verdict verdict = balance.look(kept, means.live().arrivedOf(kept.id()));
        reasonIn(verdict, failed > turnedAway).ifPresent(reason -> {
            if (!(verdict instanceof Verdict.First)) {
                means.ledger().gaps.increment();
            }
            missing = Optional.of(missing.orElse(reason));
        });
        turnedAway = failed;
        if (settings.mode() == RepairSettings.Mode.OFF) {
            missing = Optional.empty();
            return;
        }
        if (missing.isPresent()) {
            repair(kept, missing.get(), now);
            missing = Optional.empty();
            watermark.advanceTo(kept.at());
        } else if (verdict instanceof Verdict.Balanced balanced) {
            watermark.advanceTo(balanced.until());
        }
        known.flush();
    }

    private static Optional<String> reasonIn(Verdict verdict, boolean turnedAway) {
        if (verdict instanceof Verdict.Missing found) {
            return Optional.of(found.reason());
        }
        if (verdict instanceof Verdict.First) {
            return Optional.of("the source has started");
        }
        return turnedAway ? Optional.of("the source had to turn notifications away") : Optional.empty();
    }

    private void repair(Kept kept, String reason, Instant now)
            throws BrokerException, IOException, InterruptedException {
        Optional<Instant> good = watermark.time().or(() -> lastTold(kept));
        Emission emission = new Emission(means.output(), means.live(), known, kept.id());
        Repair repair = new Repair(entities, settings.reading(), means.live(), known, emission);
        gap = good.map(time -> Duration.between(time, now)).orElse(Duration.ZERO);
        long begin = System.nanoTime();
        means.live().watch();
        try {
            Optional<Instant> since = good.map(time -> time.minus(settings.overlap()))
                    .or(() -> settings.mode() == RepairSettings.Mode.INITIAL
                            ? Optional.of(Instant.EPOCH)
                            : Optional.empty());
            if (since.isPresent()) {
                repair.changesFrom(since.get());
            }
            repair.deletions();
        } finally {
            means.live().watchNoMore();
            means.ledger().repeated.add(repair.result().repeated());
        }
        report(kept, reason, repair.result(), Duration.ofNanos(System.nanoTime() - begin));
    }

    private void report(Kept kept, String reason, Repair.Result result, Duration took) {
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
                    "tenant '{}' has more than {} entities: deletions that were not notified are not found; raise"
                            + " repair.known.max if there is memory",
                    keeper.scope().service(),
                    settings.mostKnown());
        }
    }

    /** Of a subscription that was there before this task: its last success, else its making, which its id tells. */
    private static Optional<Instant> lastTold(Kept kept) {
        if (kept.state() == Kept.State.CREATED) {
            return kept.lastKnown();
        }
        return kept.report().lastSuccess().or(() -> madeAt(kept.id()));
    }

    /** The first eight of the 24 digits of a MongoDB id are seconds. */
    private static Optional<Instant> madeAt(String id) {
        try {
            return id.matches("[0-9a-f]{24}")
                    ? Optional.of(Instant.ofEpochSecond(Long.parseLong(id.substring(0, 8), 16)))
                    : Optional.empty();
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }

    FiwareScope scope() {
        return keeper.scope();
    }

    /** How long before the last repair the last known good time was. */
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
