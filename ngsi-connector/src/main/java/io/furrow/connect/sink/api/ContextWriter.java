package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.Stream;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.api.BatchSender.Failing;
import io.furrow.connect.sink.api.BatchSender.Rejected;

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
    }

    /** The answer of a context broker that cannot delete attributes. */
    private static final int METHOD_NOT_ALLOWED = 405;

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

    /** If it throws, the same changes must be applied again; repeating written ones is harmless. */
    public ChangeResults apply(List<EntityChange> changes) throws BrokerUnavailableException, WrongSettingException {
        known.evict();
        Delivery delivery = new Delivery(isolation.isDue(changes));
        try {
            firstSight.learn(changes);
            delivery.apply(changes);
            delivery.refuseFailing();
        } catch (BrokerUnavailableException e) {
            if (Isolation.isMeant(e.away())) {
                isolation.failed();
            }
            throw e;
        }
        isolation.passed();
        return delivery.results;
    }

    private final class Delivery {
        private final boolean isolates;
        private final ChangeResults results = new ChangeResults();
        private final List<Failing<EntityChange>> failing = new ArrayList<>();
        /** Whether the context broker accepted a write or a deletion, and so works. */
        private boolean anyAccepted;

        private Delivery(boolean isolates) {
            this.isolates = isolates;
        }

        private void apply(List<EntityChange> changes) throws BrokerUnavailableException, WrongSettingException {
            ChangeCoalescer coalescing = new ChangeCoalescer(known);
            changes.forEach(coalescing::add);
            DeliveryPlan plan = coalescing.plan();
            results.stale += plan.stale();
            results.coalesced += plan.coalesced();
            delete(plan.deletions());
            for (EntityChange deletion : plan.partial()) {
                deleteOlder(deletion);
            }
            write(plan.updates());
        }

        private void write(List<AttributeUpdate> updates) throws BrokerUnavailableException, WrongSettingException {
            BatchSender.Result<AttributeUpdate> result = writer.send(updates, isolates);
            for (AttributeUpdate written : result.accepted) {
                clear(written);
                written.times().forEach((name, time) -> known.set(written.key(), written.type(), name, time));
            }
            anyAccepted |= !result.accepted.isEmpty();
            result.requireComplete();
            for (Rejected<AttributeUpdate> rejected : result.rejected) {
                separate(rejected.of(), change -> refuse(change, rejected.words()));
            }
            for (Failing<AttributeUpdate> one : result.failing) {
                separate(one.of(), change -> failing.add(new Failing<>(change, one.unavailable())));
            }
        }

        /** Retries a rejected update of several changes change by change, so that a bad change affects no other. */
        private void separate(AttributeUpdate update, Consumer<EntityChange> report)
                throws BrokerUnavailableException, WrongSettingException {
            List<EntityChange> changes = new ArrayList<>(update.changes());
            if (changes.size() == 1) {
                report.accept(changes.get(0));
                return;
            }
            results.coalesced -= changes.size() - 1;
            changes.sort(Comparator.comparingLong(EntityChange::time));
            for (EntityChange change : changes) {
                apply(List.of(change));
            }
        }

        /** The values are written: a rejected deletion does not stop the delivery. */
        private void clear(AttributeUpdate written) throws BrokerUnavailableException, WrongSettingException {
            for (String name : api.cleared(written)) {
                if (known.of(written.key()).has(written.type(), name)) {
                    Outcome outcome =
                            client.send(api.delete(written.key(), new EntityTimes.Name(written.type(), name)));
                    if (outcome instanceof Outcome.Rejected rejected) {
                        refuseDeletion(written, name, rejected.words());
                    } else if (outcome instanceof Outcome.WrongSetting wrong && wrong.status() == METHOD_NOT_ALLOWED) {
                        refuseDeletion(written, name, wrong.words());
                    } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                        BatchSender.fail(outcome);
                    }
                }
            }
            results.written++;
        }

        private void refuseDeletion(AttributeUpdate written, String name, String words) {
            EntityChange newest = written.changes().get(written.changes().size() - 1);
            refuse(newest, "'%s' keeps its value: %s".formatted(name, words));
        }

        private void delete(List<EntityChange> deletions) throws BrokerUnavailableException, WrongSettingException {
            List<EntityChange> due =
                    deletions.stream().filter(each -> !isOfOtherType(each)).toList();
            results.stale += deletions.size() - due.size();
            BatchSender.Result<EntityChange> result = deleter.send(due, isolates);
            result.requireComplete();
            Stream.of(result.accepted, result.absent).flatMap(List::stream).forEach(deletion -> {
                known.delete(deletion);
                results.deleted++;
            });
            anyAccepted |= !result.accepted.isEmpty();
            result.rejected.forEach(rejected -> refuse(rejected.of(), rejected.words()));
            failing.addAll(result.failing);
        }

        /** The request to delete an entity whose id is unique would not name its type. */
        private boolean isOfOtherType(EntityChange deletion) {
            return api.isUnique(deletion.key()) && !known.of(deletion.key()).mayBeOf(deletion);
        }

        private void deleteOlder(EntityChange deletion) throws BrokerUnavailableException, WrongSettingException {
            for (EntityTimes.Name older : known.of(deletion.key()).deletedBy(deletion)) {
                Outcome outcome = client.send(api.delete(deletion.key(), older));
                if (outcome instanceof Outcome.Rejected rejected) {
                    refuse(deletion, rejected.words());
                    return;
                } else if (isolates
                        && outcome instanceof Outcome.Unavailable unavailable
                        && Isolation.isMeant(unavailable)) {
                    failing.add(new Failing<>(deletion, unavailable));
                    return;
                } else if (!(outcome instanceof Outcome.Done || outcome instanceof Outcome.Absent)) {
                    BatchSender.fail(outcome);
                }
            }
            known.delete(deletion);
            results.deleted++;
        }

        private void refuse(EntityChange change, String words) {
            results.refused.add(new RejectedChange(change, words));
        }

        /** An entity that causes a 500 alone, while the context broker accepts others, is itself at fault. */
        private void refuseFailing() throws BrokerUnavailableException {
            if (!failing.isEmpty() && !anyAccepted && !isolation.refusesWithoutProof()) {
                throw new BrokerUnavailableException(failing.get(0).unavailable());
            }
            for (Failing<EntityChange> one : failing) {
                isolation.suspect(one.of().key());
                refuse(one.of(), one.unavailable().reason());
            }
        }
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
