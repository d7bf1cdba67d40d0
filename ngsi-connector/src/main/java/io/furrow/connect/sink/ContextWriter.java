package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
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
    }

    private final BrokerClient client;
    private final ContextBrokerApi api;
    private final KnownTimes known;
    private final FirstSight firstSight;
    private final EntityWriter writer;

    ContextWriter(BrokerClient client, ContextBrokerApi api, KnownTimes known, EntityWriter writer) {
        this.client = client;
        this.api = api;
        this.known = known;
        this.firstSight = new FirstSight(client, api, known);
        this.writer = writer;
    }

    /** When it throws, the same changes must come again; those that were written do no harm then. */
    Fates apply(List<Change> changes) throws BrokerAwayException, WrongSettingException {
        known.evict();
        firstSight.learn(changes);
        Fates fates = new Fates();
        apply(changes, fates);
        return fates;
    }

    private void apply(List<Change> changes, Fates fates) throws BrokerAwayException, WrongSettingException {
        Coalescing coalescing = new Coalescing(known);
        changes.forEach(coalescing::add);
        Plan plan = coalescing.plan();
        fates.stale += plan.stale();
        fates.coalesced += plan.coalesced();
        for (Change deletion : plan.deletions()) {
            delete(deletion, fates);
        }
        for (Change deletion : plan.partial()) {
            deleteOlder(deletion, fates);
        }
        EntityWriter.Result result = writer.write(plan.updates());
        result.written().forEach(this::remember);
        fates.written += result.written().size();
        if (result.failure() != null) {
            fail(result.failure());
        }
        for (RefusedUpdate refused : result.refused()) {
            separate(refused, fates);
        }
    }

    /** A refused update of several changes is tried change by change: one of them harms no other. */
    private void separate(RefusedUpdate refused, Fates fates) throws BrokerAwayException, WrongSettingException {
        List<Change> changes = new ArrayList<>(refused.update().changes());
        if (changes.size() == 1) {
            fates.refused.add(new RefusedChange(changes.get(0), refused.words()));
            return;
        }
        fates.coalesced -= changes.size() - 1;
        changes.sort(Comparator.comparingLong(Change::time));
        for (Change change : changes) {
            apply(List.of(change), fates);
        }
    }

    private void deleteOlder(Change deletion, Fates fates) throws BrokerAwayException, WrongSettingException {
        for (EntityTimes.Name older : known.of(deletion.key()).upTo(deletion.time())) {
            Outcome outcome = client.send(api.delete(deletion.key(), older));
            if (outcome instanceof Outcome.Refused refusal) {
                fates.refused.add(new RefusedChange(deletion, refusal.words()));
                return;
            } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                fail(outcome);
            }
        }
        known.outlive(deletion.key(), deletion.time());
        fates.deleted++;
    }

    private void delete(Change deletion, Fates fates) throws BrokerAwayException, WrongSettingException {
        Outcome outcome = client.send(api.delete(deletion.key()));
        if (outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent) {
            known.delete(deletion.key(), deletion.time());
            fates.deleted++;
        } else if (outcome instanceof Outcome.Refused refusal) {
            fates.refused.add(new RefusedChange(deletion, refusal.words()));
        } else {
            fail(outcome);
        }
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
