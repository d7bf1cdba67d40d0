package io.furrow.control.context;

import java.time.Duration;
import java.util.Arrays;
import java.util.List;
import java.util.Objects;
import java.util.TreeSet;

import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.control.alarm.watch.FieldWindow;
import io.furrow.control.domain.Domain;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.time.Elapsed;

/**
 * Publishes domains and missions to the context broker: each changed entity at most once a second, and only if it
 * differs from the one last published.
 */
final class ContextProjection {
    /** Averages older than this are discarded. */
    static final Duration MAX_FIELD_AGE = Duration.ofHours(1);

    private static final Duration FIELDS_POLL_INTERVAL = Duration.ofMinutes(1);

    private final ContextTables tables;
    private final PublicationListener listener;
    private long fieldsReadAt;

    /** Receives the changes to publish to the context broker. */
    interface PublicationListener {
        void changed(EntityBuilder entity);

        void deleted(String type, String entityId);
    }

    ContextProjection(ContextTables tables, PublicationListener listener) {
        this.tables = tables;
        this.listener = listener;
    }

    /** @param domain null if it was deleted */
    void domain(String name, Domain domain) {
        tables.domains().put(name, domain == null ? null : domain.withoutArea());
        markOutdated(ContextEntity.domainId(name));
    }

    /** @param mission null if it was deleted */
    void mission(String name, Mission mission) {
        Mission before = tables.missions().get(name);
        tables.missions().put(name, mission);
        MissionCounts counts = tables.tallies().get(name);
        if (mission == null) {
            tables.tallies().put(name, null);
        } else if (counts == null || mission.running() && !Objects.equals(mission.start(), counts.start())) {
            tables.tallies().put(name, MissionCounts.of(name, mission.start()));
        }
        markOutdated(ContextEntity.missionId(name));
        Mission newest = mission == null ? before : mission;
        if (newest != null && (mission == null || before == null)) {
            markOutdated(ContextEntity.domainId(newest.domain()));
        }
    }

    /** @param status null if the mission was deleted */
    void status(String mission, MissionStatus status) {
        tables.statuses().put(mission, status);
        markOutdated(ContextEntity.missionId(mission));
    }

    /** Counts an encounter for the missions of both devices. */
    void encounter(EncounterReport encounter) {
        TreeSet<String> missions = new TreeSet<>();
        encounter.members().forEach(member -> missions.add(member.mission()));
        for (String mission : missions) {
            MissionCounts before = mission.isEmpty() ? null : tables.tallies().get(mission);
            MissionCounts after = before == null ? null : before.with(encounter);
            if (after != null && !after.equals(before)) {
                tables.tallies().put(mission, after);
                markOutdated(ContextEntity.missionId(mission));
            }
        }
    }

    /**
     * @param scope of the averaged devices
     * @param now epoch ms
     */
    void window(FieldWindow window, FiwareScope scope, long now) {
        FieldState state = FieldState.of(window, scope, now);
        FieldState before = tables.fields().get(state.key());
        if (before == null || before.windowEnd() <= window.windowEnd()) {
            tables.fields().put(state.key(), state);
            markDomainsOutdated(state);
        }
    }

    /** Called about once a second, on one projection only. */
    void passTime(long now) {
        if (Elapsed.hasPassed(FIELDS_POLL_INTERVAL.toMillis(), fieldsReadAt, now)) {
            fieldsReadAt = now;
            forgetOldFields(now);
        }
        List<String> outdated = tables.outdated().all();
        if (outdated.isEmpty()) {
            return;
        }
        TreeSet<String> ids = new TreeSet<>(outdated);
        tables.domains().forEach(domain -> {
            if (ids.remove(ContextEntity.domainId(domain.domain()))) {
                publish(entity(domain));
            }
        });
        tables.missions().forEach(mission -> {
            if (ids.remove(ContextEntity.missionId(mission.mission()))) {
                String name = mission.mission();
                publish(ContextEntity.of(
                        mission, tables.statuses().get(name), tables.tallies().get(name)));
            }
        });
        ids.forEach(this::publishDeleted);
        outdated.forEach(id -> tables.outdated().put(id, null));
    }

    private void forgetOldFields(long now) {
        for (FieldState field :
                tables.fields().where(each -> Elapsed.hasPassed(MAX_FIELD_AGE.toMillis(), each.known(), now))) {
            tables.fields().put(field.key(), null);
            markDomainsOutdated(field);
        }
    }

    private EntityBuilder entity(Domain domain) {
        int missions = tables.missions()
                .where(mission -> mission.domain().equals(domain.domain()))
                .size();
        return ContextEntity.of(domain, missions, tables.fields().where(field -> isOf(field, domain)));
    }

    /** Whether the domain lists the field or the field names the domain. */
    private static boolean isOf(FieldState field, Domain domain) {
        return domain.domain().equals(field.domain())
                || domain.details().fields() != null
                        && domain.details().fields().contains(field.field());
    }

    private void markDomainsOutdated(FieldState field) {
        tables.domains()
                .where(domain -> isOf(field, domain))
                .forEach(domain -> markOutdated(ContextEntity.domainId(domain.domain())));
    }

    private void markOutdated(String entityId) {
        if (tables.outdated().get(entityId) == null) {
            tables.outdated().put(entityId, entityId);
        }
    }

    private void publish(EntityBuilder entity) {
        byte[] json = entity.toBytes();
        if (!Arrays.equals(json, tables.publishedEntities().get(entity.id()))) {
            tables.publishedEntities().put(entity.id(), json);
            listener.changed(entity);
        }
    }

    private void publishDeleted(String entityId) {
        if (tables.publishedEntities().get(entityId) != null) {
            tables.publishedEntities().put(entityId, null);
            listener.deleted(ContextEntity.typeOf(entityId), entityId);
        }
    }
}
