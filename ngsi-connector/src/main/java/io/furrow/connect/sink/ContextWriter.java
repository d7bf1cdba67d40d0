package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.EntityWriter.FailingUpdate;
import io.furrow.connect.sink.EntityWriter.RefusedUpdate;

/**
 * Brings a context broker to the state that changes say: of each attribute the value with the newest event time, whatever
 * the order in which they come and however often, as long as the times of the entity are known or can be read.
 */
final class ContextWriter implements AutoCloseable {
    /** A change that the context broker does not take, and its words. */
    record RefusedChange(Change change, String words) {}

    /** How many changes met which fate; together they are as many as there were. */
    static final class Fates {
        int written;
        int coalesced;
        int stale;
        int deleted;
        final List<RefusedChange> refused = new ArrayList<>();
        private final List<FailingChange> failing = new ArrayList<>();
        /** Whether the context broker took a write or a deletion, and so works. */
        private boolean anyTaken;
    }

    private final BrokerClient client;
    private final ContextBrokerApi api;
    private final KnownTimes known;
    private final FirstSight firstSight;
    private final EntityWriter writer;
    private final EntityDeleter deleter;
    private final Isolation isolation;

    /** @param parallel how many requests may be under way at a time */
    ContextWriter(
            BrokerClient client,
            ContextBrokerApi api,
            KnownTimes known,
            Batches batches,
            int parallel,
            Isolation isolation) {
        this.client = client;
        this.api = api;
        this.known = known;
        this.firstSight = new FirstSight(client, api, known);
        this.writer = new EntityWriter(client, api, batches, parallel);
        this.deleter = new EntityDeleter(client, api, firstSight, batches);
        this.isolation = isolation;
    }

    /** When it throws, the same changes must come again; those that were written do no harm then. */
    Fates apply(List<Change> changes) throws BrokerAwayException, WrongSettingException {
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

    /** What draws a 500 alone while the context broker takes others is at fault itself. */
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
        Coalescing coalescing = new Coalescing(known);
        changes.forEach(coalescing::add);
        Plan plan = coalescing.plan();
        fates.stale += plan.stale();
        fates.coalesced += plan.coalesced();
        delete(plan.deletions(), apart, fates);
        for (Change deletion : plan.partial()) {
            deleteOlder(deletion, apart, fates);
        }
        EntityWriter.Result result = writer.write(plan.updates(), apart);
        result.written().forEach(this::remember);
        fates.written += result.written().size();
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

    /** An update of several changes that is not taken is tried change by change: one of them harms no other. */
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

    /** Forgets what it knows: others may have written meanwhile. */
    void forget() {
        known.clear();
    }

    @Override
    public void close() {
        writer.close();
    }
}
