package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Clock;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.Predicate;

import io.furrow.connect.broker.BrokerException;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;

/** Reads changes that may have been missed once, and emits the states that the topic does not have. */
final class Repair {
    private final BrokerEntities entities;
    private final RepairSettings.Reading reading;
    private final RecordTracker live;
    private final EntityIdSet known;
    private final RepairPublisher emission;
    private int changed;
    private int repeated;
    private int deleted;

    Repair(
            BrokerEntities entities,
            RepairSettings.Reading reading,
            RecordTracker live,
            EntityIdSet known,
            RepairPublisher emission) {
        this.entities = entities;
        this.reading = reading;
        this.live = live;
        this.known = known;
        this.emission = emission;
    }

    /** The findings, for a log message. */
    record Result(int changed, int repeated, int deleted) {}

    Result result() {
        return new Result(changed, repeated, deleted);
    }

    /** Emits the state of entities that changed since a time. */
    void changesFrom(Instant since) throws BrokerException, InterruptedException, IOException {
        long[] asked = {live.now()};
        new KeysetReader(
                        (from, offset, limit) -> {
                            asked[0] = live.now();
                            return entities.modifiedFrom(from, offset, limit);
                        },
                        reading.pageSize())
                .readFrom(since, states -> emit(states, asked[0]));
    }

    private void emit(List<EntityState> states, long asked) throws InterruptedException, IOException {
        Instant now = Clock.systemUTC().instant();
        List<MissedChange> findings = new ArrayList<>();
        for (EntityState state : states) {
            if (!reading.isExcluded(state.entity().type())) {
                findings.add(finding(state, now));
            }
        }
        int emitted = emission.emit(findings, asked);
        changed += emitted;
        repeated += findings.size() - emitted;
    }

    private MissedChange finding(EntityState state, Instant now) {
        if (state.problem().isPresent()) {
            return new MissedChange.Unreadable(state, now);
        }
        EntityEvent event = EntityEvent.of(state.entity(), state.scope(), now, reading.times(), Origin.REPAIR);
        return MissedChange.Changed.of(event, state.time());
    }

    /** Reads entities again whose last record may not be the newest. */
    void stale(Predicate<FiwareScope> ours) throws BrokerException, InterruptedException, IOException {
        for (String identity : live.stale()) {
            FiwareScope place = EntityKeys.scope(identity);
            if (ours.test(place)) {
                readAgain(identity, place);
            }
        }
    }

    private void readAgain(String identity, FiwareScope place)
            throws BrokerException, InterruptedException, IOException {
        long asked = live.now();
        List<EntityState> states = entities.ofId(place, EntityKeys.id(identity)).stream()
                .filter(state -> state.identity().equals(identity))
                .toList();
        if (states.isEmpty()) {
            emitEnd(identity, asked);
            return;
        }
        List<EntityState> own = states.stream().filter(this::isOwn).toList();
        if (own.isEmpty()) {
            live.settle(identity);
        }
        emit(own, asked);
    }

    private boolean isOwn(EntityState state) {
        return entities.covers(state) && !reading.isExcluded(state.entity().type());
    }

    /** Marks an entity to be read again. */
    interface Marking {
        void mark(String identity) throws IOException;
    }

    /**
     * Emits the deletions of entities that no longer exist, and registers existing ones. An entity that was created
     * before the watermark and is not known was deleted on the topic and is back: its state may be older than any that
     * is read for a gap.
     */
    void deletions(ListingSchedule listings, Optional<Instant> watermark, Marking back)
            throws BrokerException, InterruptedException, IOException {
        if (known.isOverfull()) {
            return;
        }
        Set<String> missing = known.copy();
        int before = missing.size();
        new KeysetReader(entities::createdFrom, reading.pageSize()).readFrom(Instant.EPOCH, states -> {
            for (EntityState state : states) {
                if (!reading.isExcluded(state.entity().type())) {
                    String identity = state.identity();
                    missing.remove(identity);
                    if (!known.contains(identity)
                            && !known.isIncomplete()
                            && watermark.filter(state.time()::isBefore).isPresent()) {
                        back.mark(identity); // known once its state is on the topic
                    } else {
                        known.add(identity);
                    }
                }
            }
        });
        if (known.isOverfull()) {
            return;
        }
        known.completed();
        for (String identity : new TreeSet<>(listings.deleted(missing, before))) {
            checkGone(identity);
        }
    }

    /**
     * An entity that exists but was not listed was created again meanwhile, or no longer belongs to the subscription.
     */
    private void checkGone(String identity) throws BrokerException, InterruptedException, IOException {
        if (!known.contains(identity)) {
            return;
        }
        long asked = live.now();
        Optional<EntityState> there = entities.stubsOfId(EntityKeys.scope(identity), EntityKeys.id(identity)).stream()
                .filter(state -> state.identity().equals(identity))
                .findFirst();
        if (there.isEmpty()) {
            emitEnd(identity, asked);
        } else if (!isOwn(there.get())) {
            known.remove(identity);
        }
    }

    private void emitEnd(String identity, long asked) throws InterruptedException, IOException {
        Instant now = Clock.systemUTC().instant();
        EntityDeletion deletion = new EntityDeletion(
                EntityKeys.type(identity),
                EntityKeys.id(identity),
                EntityKeys.scope(identity),
                now,
                now,
                Origin.REPAIR);
        deleted += emission.emit(List.of(new MissedChange.Deleted(deletion)), asked);
    }
}
