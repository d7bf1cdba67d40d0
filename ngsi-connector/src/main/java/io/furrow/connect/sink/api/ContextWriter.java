package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.EntityWriter.FailingUpdate;
import io.furrow.connect.sink.api.EntityWriter.RejectedUpdate;

/**
 * Writes changes to a context broker: per attribute the value with the newest event time is stored, whatever the order
 * and number of arrivals, as long as the times of the entity are known or can be read.
 */
public final class ContextWriter implements AutoCloseable {
    /** A change that the context broker rejects, and its reason. */
    public record RejectedChange(EntityChange entityChange, String words) {}

    /** Counts the changes by result; the counts add up to the number of changes. */
    public static final class ChangeResults {
        public int written;
        public int coalesced;
        public int stale;
        public int deleted;
        public final List<RejectedChange> refused = new ArrayList<>();
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
    public ChangeResults apply(List<EntityChange> changes) throws BrokerUnavailableException, WrongSettingException {
        known.evict();
        ChangeResults changeResults = new ChangeResults();
        try {
            firstSight.learn(changes);
            apply(changes, isolation.isDue(changes), changeResults);
            refuseFailing(changeResults);
        } catch (BrokerUnavailableException e) {
            if (FailingChange.isMeant(e.away())) {
                isolation.failed();
            }
            throw e;
        }
        isolation.passed();
        return changeResults;
    }

    /** An entity that causes a 500 alone, while the context broker accepts others, is itself at fault. */
    private void refuseFailing(ChangeResults changeResults) throws BrokerUnavailableException {
        if (changeResults.failing.isEmpty()) {
            return;
        }
        if (!changeResults.anyTaken && !isolation.refusesWithoutProof()) {
            throw new BrokerUnavailableException(changeResults.failing.get(0).unavailable());
        }
        for (FailingChange failing : changeResults.failing) {
            isolation.suspect(failing.entityChange().key());
            changeResults.refused.add(new RejectedChange(
                    failing.entityChange(), failing.unavailable().reason()));
        }
    }

    private void apply(List<EntityChange> changes, boolean apart, ChangeResults changeResults)
            throws BrokerUnavailableException, WrongSettingException {
        ChangeCoalescer coalescing = new ChangeCoalescer(known);
        changes.forEach(coalescing::add);
        DeliveryPlan deliveryPlan = coalescing.plan();
        changeResults.stale += deliveryPlan.stale();
        changeResults.coalesced += deliveryPlan.coalesced();
        delete(deliveryPlan.deletions(), apart, changeResults);
        for (EntityChange deletion : deliveryPlan.partial()) {
            deleteOlder(deletion, apart, changeResults);
        }
        EntityWriter.Result result = writer.write(deliveryPlan.updates(), apart);
        for (AttributeUpdate written : result.written()) {
            clear(written, changeResults);
            remember(written);
        }
        changeResults.anyTaken |= !result.written().isEmpty();
        if (result.failure() != null) {
            fail(result.failure());
        }
        for (RejectedUpdate refused : result.refused()) {
            Consumer<EntityChange> report =
                    entityChange -> changeResults.refused.add(new RejectedChange(entityChange, refused.words()));
            separate(refused.attributeUpdate(), report, apart, changeResults);
        }
        for (FailingUpdate failing : result.failing()) {
            Consumer<EntityChange> report =
                    entityChange -> changeResults.failing.add(new FailingChange(entityChange, failing.unavailable()));
            separate(failing.attributeUpdate(), report, apart, changeResults);
        }
    }

    /** Retries a rejected update of several changes change by change, so that a bad change affects no other. */
    private void separate(
            AttributeUpdate attributeUpdate, Consumer<EntityChange> report, boolean apart, ChangeResults changeResults)
            throws BrokerUnavailableException, WrongSettingException {
        List<EntityChange> changes = new ArrayList<>(attributeUpdate.changes());
        if (changes.size() == 1) {
            report.accept(changes.get(0));
            return;
        }
        changeResults.coalesced -= changes.size() - 1;
        changes.sort(Comparator.comparingLong(EntityChange::time));
        for (EntityChange entityChange : changes) {
            apply(List.of(entityChange), apart, changeResults);
        }
    }

    private void deleteOlder(EntityChange deletion, boolean apart, ChangeResults changeResults)
            throws BrokerUnavailableException, WrongSettingException {
        for (EntityTimes.Name older : known.of(deletion.key()).upTo(deletion.time())) {
            Outcome outcome = client.send(api.delete(deletion.key(), older));
            if (outcome instanceof Outcome.Rejected refusal) {
                changeResults.refused.add(new RejectedChange(deletion, refusal.words()));
                return;
            } else if (apart
                    && outcome instanceof Outcome.Unavailable unavailable
                    && FailingChange.isMeant(unavailable)) {
                changeResults.failing.add(new FailingChange(deletion, unavailable));
                return;
            } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                fail(outcome);
            }
        }
        known.outlive(deletion.key(), deletion.time());
        changeResults.deleted++;
    }

    /** The values are written: what a context broker refuses to delete is no reason not to go on. */
    private void clear(AttributeUpdate written, ChangeResults changeResults)
            throws BrokerUnavailableException, WrongSettingException {
        for (String name : api.cleared(written)) {
            if (known.of(written.key()).has(written.type(), name)) {
                Outcome outcome = client.send(api.delete(written.key(), new EntityTimes.Name(written.type(), name)));
                if (outcome instanceof Outcome.Unavailable) {
                    fail(outcome);
                } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                    String words = outcome instanceof Outcome.Rejected refusal ? refusal.words() : outcome.toString();
                    EntityChange newest =
                            written.changes().get(written.changes().size() - 1);
                    changeResults.refused.add(
                            new RejectedChange(newest, "'%s' keeps its value: %s".formatted(name, words)));
                }
            }
        }
        changeResults.written++;
    }

    private void delete(List<EntityChange> deletions, boolean apart, ChangeResults changeResults)
            throws BrokerUnavailableException, WrongSettingException {
        EntityDeleter.Result result = deleter.delete(deletions, apart);
        result.deleted().forEach(deletion -> known.delete(deletion.key(), deletion.time()));
        result.absent().forEach(deletion -> known.delete(deletion.key(), deletion.time()));
        changeResults.deleted += result.deleted().size() + result.absent().size();
        changeResults.anyTaken |= !result.deleted().isEmpty();
        changeResults.refused.addAll(result.refused());
        changeResults.failing.addAll(result.failing());
    }

    private void remember(AttributeUpdate attributeUpdate) {
        attributeUpdate
                .times()
                .forEach((name, time) -> known.set(attributeUpdate.key(), attributeUpdate.type(), name, time));
    }

    private static void fail(Outcome outcome) throws BrokerUnavailableException, WrongSettingException {
        if (outcome instanceof Outcome.Unavailable unavailable) {
            throw new BrokerUnavailableException(unavailable);
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
