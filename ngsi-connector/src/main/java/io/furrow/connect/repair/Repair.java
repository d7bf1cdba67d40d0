package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Clock;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import io.furrow.connect.broker.BrokerException;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;

/** One reading of what may have been missed, and the emission of what was not seen. */
final class Repair {
    private final BrokerEntities entities;
    private final RepairSettings.Reading reading;
    private final LiveEvents live;
    private final KnownEntities known;
    private final Emission emission;
    private int changed;
    private int repeated;
    private int deleted;

    Repair(
            BrokerEntities entities,
            RepairSettings.Reading reading,
            LiveEvents live,
            KnownEntities known,
            Emission emission) {
        this.entities = entities;
        this.reading = reading;
        this.live = live;
        this.known = known;
        this.emission = emission;
    }

    /** What was found, in the words of a log line. */
    record Result(int changed, int repeated, int deleted) {}

    Result result() {
        return new Result(changed, repeated, deleted);
    }

    /** Emits the state of what changed from a time on. */
    void changesFrom(Instant since) throws BrokerException, InterruptedException, IOException {
        Asked asked = new Asked();
        new KeysetReader(
                        (from, offset, limit) -> {
                            asked.now();
                            return entities.modifiedFrom(from, offset, limit);
                        },
                        reading.pageSize())
                .readFrom(since, states -> emit(states, asked));
        known.flush();
    }

    private void emit(List<EntityState> states, Asked asked) throws InterruptedException, IOException {
        Instant now = Clock.systemUTC().instant();
        List<Finding> findings = new ArrayList<>();
        for (EntityState state : states) {
            if (reading.isExcluded(state.entity().type())) {
                continue;
            }
            EntityEvent event = EntityEvent.of(state.entity(), state.scope(), now, reading.times(), Origin.REPAIR);
            if (live.isSeen(event.id())) {
                repeated++;
                known.add(state.identity());
            } else {
                findings.add(new Finding.Changed(event));
            }
        }
        int emitted = emission.emit(findings, asked.at);
        changed += emitted;
        repeated += findings.size() - emitted;
    }

    /** Emits the end of what is gone, and learns what there is. */
    void deletions() throws BrokerException, InterruptedException, IOException {
        if (known.isOverfull()) {
            return;
        }
        Set<String> candidates = known.copy();
        Set<String> there = new HashSet<>();
        new KeysetReader(entities::createdFrom, reading.pageSize())
                .readFrom(Instant.EPOCH, states -> learn(states, there));
        if (known.isOverfull()) {
            return;
        }
        candidates.removeAll(there);
        for (String identity : new java.util.TreeSet<>(candidates)) {
            checkGone(identity);
        }
        known.flush();
    }

    private void learn(List<EntityState> states, Set<String> there) throws IOException {
        for (EntityState state : states) {
            if (!known.isOverfull() && !reading.isExcluded(state.entity().type())) {
                there.add(state.identity());
                known.add(state.identity());
            }
        }
    }

    /** One that is there but was not read is none of ours any more. */
    private void checkGone(String identity) throws BrokerException, InterruptedException, IOException {
        Asked asked = new Asked();
        FiwareScope place = Identities.scope(identity);
        String id = Identities.id(identity);
        if (!known.contains(identity)) {
            return;
        }
        if (entities.isPresent(place, id)) {
            known.remove(identity);
            return;
        }
        Instant now = Clock.systemUTC().instant();
        EntityDeletion deletion = new EntityDeletion(id, place, now, now, Origin.REPAIR);
        deleted += emission.emit(List.of(new Finding.Deleted(deletion)), asked.at);
    }

    /** When the context broker was last asked. */
    private static final class Asked {
        private long at = System.nanoTime();

        private void now() {
            at = System.nanoTime();
        }
    }
}
