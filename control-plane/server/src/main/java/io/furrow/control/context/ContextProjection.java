package io.furrow.control.context;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Objects;
import java.util.TreeSet;
import java.util.concurrent.atomic.AtomicInteger;

import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.control.alarm.watch.FieldWindow;
import io.furrow.control.domain.Domain;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.ngsi.EntityBuilder;

/**
 * Publishes domains and missions to the context broker: each changed entity at most once a second, and only if it
 * differs from the one last published.
 */
final class ContextProjection {
    /** Averages older than this are discarded. */
    static final Duration FIELD_HOLDS = Duration.ofHours(1);

    private static final Duration FIELDS_POLL_INTERVAL = Duration.ofMinutes(1);

    private final ContextTables records;
    private final PublicationListener told;
    private long fieldsLookedAt;

    /** Receives the changes to publish to the context broker. */
    interface PublicationListener {
        void changed(EntityBuilder entity);

        void deleted(String type, String entityId);
    }

    ContextProjection(ContextTables records, PublicationListener told) {
        this.records = records;
        this.told = told;
    }

    /** @param domain null if it was deleted */
    void domain(String name, Domain domain) {
        records.domains().put(name, domain == null ? null : domain.withoutArea());
        outdate(ContextEntity.domainId(name));
    }

    /** @param mission null if it was deleted */
    void mission(String name, Mission mission) {
        Mission before = records.missions().get(name);
        records.missions().put(name, mission);
        MissionCounts tally = records.tallies().get(name);
        if (mission == null) {
            records.tallies().put(name, null);
        } else if (tally == null || mission.running() && !Objects.equals(mission.start(), tally.start())) {
            records.tallies().put(name, MissionCounts.of(name, mission.start()));
        }
        outdate(ContextEntity.missionId(name));
        Mission either = mission == null ? before : mission;
        if (either != null && (mission == null || before == null)) {
            outdate(ContextEntity.domainId(either.domain()));
        }
    }

    /** @param status null if the mission was deleted */
    void status(String mission, MissionStatus status) {
        records.statuses().put(mission, status);
        outdate(ContextEntity.missionId(mission));
    }

    /** Counts an encounter for the missions of both devices, if these are known. */
    void encounter(EncounterReport encounter) {
        TreeSet<String> missions = new TreeSet<>();
        encounter.members().forEach(member -> missions.add(member.mission()));
        for (String mission : missions) {
            MissionCounts before = mission.isEmpty() ? null : records.tallies().get(mission);
            MissionCounts after = before == null ? null : before.with(encounter);
            if (after != null && !after.equals(before)) {
                records.tallies().put(mission, after);
                outdate(ContextEntity.missionId(mission));
            }
        }
    }

    /** @param now epoch ms */
    void window(FieldWindow window, long now) {
        FieldState before = records.fields().get(window.field());
        if (before == null || before.windowEnd() <= window.windowEnd()) {
            FieldState state = FieldState.of(window, now);
            records.fields().put(window.field(), state);
            outdateDomainsOf(state);
        }
    }

    /** Called about once a second, on one projection only. */
    void passTime(long now) {
        if (now - fieldsLookedAt >= FIELDS_POLL_INTERVAL.toMillis()) {
            fieldsLookedAt = now;
            forgetOldFields(now);
        }
        List<String> outdated = new ArrayList<>();
        records.outdated().forEach(outdated::add);
        if (outdated.isEmpty()) {
            return;
        }
        TreeSet<String> ids = new TreeSet<>(outdated);
        records.domains().forEach(domain -> {
            if (ids.remove(ContextEntity.domainId(domain.domain()))) {
                tell(entity(domain));
            }
        });
        records.missions().forEach(mission -> {
            if (ids.remove(ContextEntity.missionId(mission.mission()))) {
                String name = mission.mission();
                tell(ContextEntity.of(
                        mission, records.statuses().get(name), records.tallies().get(name)));
            }
        });
        ids.forEach(this::tellDeleted);
        outdated.forEach(id -> records.outdated().put(id, null));
    }

    private void forgetOldFields(long now) {
        List<FieldState> old = new ArrayList<>();
        records.fields().forEach(field -> {
            if (field.known() + FIELD_HOLDS.toMillis() <= now) {
                old.add(field);
            }
        });
        for (FieldState field : old) {
            records.fields().put(field.field(), null);
            outdateDomainsOf(field);
        }
    }

    private EntityBuilder entity(Domain domain) {
        AtomicInteger missions = new AtomicInteger();
        records.missions().forEach(mission -> {
            if (mission.domain().equals(domain.domain())) {
                missions.incrementAndGet();
            }
        });
        List<FieldState> fields = new ArrayList<>();
        records.fields().forEach(field -> {
            if (isOf(field, domain)) {
                fields.add(field);
            }
        });
        return ContextEntity.of(domain, missions.get(), fields);
    }

    /** Whether the domain lists the field or the field names the domain. */
    private static boolean isOf(FieldState field, Domain domain) {
        return domain.domain().equals(field.domain())
                || domain.fields() != null && domain.fields().contains(field.field());
    }

    private void outdateDomainsOf(FieldState field) {
        records.domains().forEach(domain -> {
            if (isOf(field, domain)) {
                outdate(ContextEntity.domainId(domain.domain()));
            }
        });
    }

    private void outdate(String entityId) {
        if (records.outdated().get(entityId) == null) {
            records.outdated().put(entityId, entityId);
        }
    }

    private void tell(EntityBuilder entity) {
        byte[] json = entity.toBytes();
        if (!Arrays.equals(json, records.told().get(entity.id()))) {
            records.told().put(entity.id(), json);
            told.changed(entity);
        }
    }

    private void tellDeleted(String entityId) {
        if (records.told().get(entityId) != null) {
            records.told().put(entityId, null);
            told.deleted(ContextEntity.typeOf(entityId), entityId);
        }
    }
}
