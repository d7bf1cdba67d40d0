package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.EntityWriter.FailingUpdate;
import io.furrow.connect.sink.api.EntityWriter.RefusedUpdate;

/**
 * Writes changes to a context broker: per attribute the value with the newest event time is stored, whatever the order
 * and number of arrivals, as long as the times of the entity are known or can be read.
 */
public final class ContextWriter implements AutoCloseable {
    /** A change that the context broker rejects, and its reason. */
    public record RefusedChange(Change change, String words) {}

    /** Counts the changes by result; the counts add up to the number of changes. */
    public static final class Fates {
        public int written;
        public int coalesced;
        public int stale;
        public int deleted;
        public final List<RefusedChange> refused = new ArrayList<>();
        private final List<FailingChange> failing = new ArrayList<>();
        /** Whether the context broker accepted a write or a deletion, and so works. */
        private boolean anyTaken;
    }

    private final BrokerClient client;
    private final ContextBrokerApi api;
    private final EntityTimesCache known;
    private final EntityTimesLoader firstSight;
    private final EntityWriter writer;
    private final EntityDeleter deleter;
    private final Isolation isolation;

    /** @param parallel maximum concurrent requests */
    public ContextWriter(
            BrokerClient client,
            ContextBrokerApi api,
            EntityTimesCache known,
            Batches batches,
            int parallel,
            Isolation isolation) {
        this.client = client;
        this.api = api;
        this.known = known;
        this.firstSight = new EntityTimesLoader(client, api, known);
        this.writer = new EntityWriter(client, api, batches, parallel);
        this.deleter = new EntityDeleter(client, api, firstSight, batches);
        this.isolation = isolation;
    }

    /** If it throws, the same changes must be applied again; repeating the written ones does no harm. */
    public Fates apply(List<Change> changes) throws BrokerAwayException, WrongSettingException {
        known.evict();
        Fates fates = new Fates();
        try {
            firstSight.learn(changes);
            apply(changes, isolation.isDue(changes), fates);
            refuseFailing(fates);
        } catch (BrokerAwayException e) {
            if (FailingChange.isMeant(e.away())) {
                isolation.failed();
            }
            throw e;
        }
        isolation.passed();
        return fates;
    }

    /** An entity that causes a 500 alone, while the context broker accepts others, is itself at fault. */
    private void refuseFailing(Fates fates) throws BrokerAwayException {
        if (fates.failing.isEmpty()) {
            return;
        }
        if (!fates.anyTaken && !isolation.refusesWithoutProof()) {
            throw new BrokerAwayException(fates.failing.get(0).away());
        }
        for (FailingChange failing : fates.failing) {
            isolation.suspect(failing.change().key());
            fates.refused.add(new RefusedChange(failing.change(), failing.away().reason()));
        }
    }

    private void apply(List<Change> changes, boolean apart, Fates fates)
            throws BrokerAwayException, WrongSettingException {
        ChangeCoalescer coalescing = new ChangeCoalescer(known);
        changes.forEach(coalescing::add);
        Plan plan = coalescing.plan();
        fates.stale += plan.stale();
        fates.coalesced += plan.coalesced();
        delete(plan.deletions(), apart, fates);
        for (Change deletion : plan.partial()) {
            deleteOlder(deletion, apart, fates);
        }
        EntityWriter.Result result = writer.write(plan.updates(), apart);
        for (Update written : result.written()) {
            clear(written, fates);
            remember(written);
        }
        fates.anyTaken |= !result.written().isEmpty();
        if (result.failure() != null) {
            fail(result.failure());
        }
        for (RefusedUpdate refused : result.refused()) {
            Consumer<Change> fate = change -> fates.refused.add(new RefusedChange(change, refused.words()));
            separate(refused.update(), fate, apart, fates);
        }
        for (FailingUpdate failing : result.failing()) {
            Consumer<Change> fate = change -> fates.failing.add(new FailingChange(change, failing.away()));
            separate(failing.update(), fate, apart, fates);
        }
    }

    /** Retries a rejected update of several changes change by change, so that a bad change affects no other. */
    private void separate(Update update, Consumer<Change> fate, boolean apart, Fates fates)
            throws BrokerAwayException, WrongSettingException {
        List<Change> changes = new ArrayList<>(update.changes());
        if (changes.size() == 1) {
            fate.accept(changes.get(0));
            return;
        }
        fates.coalesced -= changes.size() - 1;
        changes.sort(Comparator.comparingLong(Change::time));
        for (Change change : changes) {
            apply(List.of(change), apart, fates);
        }
    }

    private void deleteOlder(Change deletion, boolean apart, Fates fates)
            throws BrokerAwayException, WrongSettingException {
        for (EntityTimes.Name older : known.of(deletion.key()).upTo(deletion.time())) {
            Outcome outcome = client.send(api.delete(deletion.key(), older));
            if (outcome instanceof Outcome.Refused refusal) {
                fates.refused.add(new RefusedChange(deletion, refusal.words()));
                return;
            } else if (apart && outcome instanceof Outcome.Away away && FailingChange.isMeant(away)) {
                fates.failing.add(new FailingChange(deletion, away));
                return;
            } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                fail(outcome);
            }
        }
        known.outlive(deletion.key(), deletion.time());
        fates.deleted++;
    }

    /** The values are written: what a context broker refuses to delete is no reason not to go on. */
    private void clear(Update written, Fates fates) throws BrokerAwayException, WrongSettingException {
        for (String name : api.cleared(written)) {
            if (known.of(written.key()).has(written.type(), name)) {
                Outcome outcome = client.send(api.delete(written.key(), new EntityTimes.Name(written.type(), name)));
                if (outcome instanceof Outcome.Away) {
                    fail(outcome);
                } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                    String words = outcome instanceof Outcome.Refused refusal ? refusal.words() : outcome.toString();
                    Change newest = written.changes().get(written.changes().size() - 1);
                    fates.refused.add(new RefusedChange(newest, "'%s' keeps its value: %s".formatted(name, words)));
                }
            }
        }
        fates.written++;
    }

    private void delete(List<Change> deletions, boolean apart, Fates fates)
            throws BrokerAwayException, WrongSettingException {
        EntityDeleter.Result result = deleter.delete(deletions, apart);
        result.deleted().forEach(deletion -> known.delete(deletion.key(), deletion.time()));
        result.absent().forEach(deletion -> known.delete(deletion.key(), deletion.time()));
        fates.deleted += result.deleted().size() + result.absent().size();
        fates.anyTaken |= !result.deleted().isEmpty();
        fates.refused.addAll(result.refused());
        fates.failing.addAll(result.failing());
    }

    private void remember(Update update) {
        update.times().forEach((name, time) -> known.set(update.key(), update.type(), name, time));
    }

    private static void fail(Outcome outcome) throws BrokerAwayException, WrongSettingException {
        if (outcome instanceof Outcome.Away away) {
            throw new BrokerAwayException(away);
        }
        throw new WrongSettingException(
                outcome instanceof Outcome.WrongSetting wrong ? wrong.words() : outcome.toString());
    }

    /** Clears the cache: other tasks may have written meanwhile. */
    public void forget() {
        known.clear();
    }

    @Override
    public void close() {
        writer.close();
    }
}
