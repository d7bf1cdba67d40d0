package io.furrow.cli.compare;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.compare.AnalyticsResult.Average;
import io.furrow.cli.compare.AnalyticsResult.Encounter;
import io.furrow.cli.compare.AnalyticsResult.Visit;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.result.CollisionResult;
import io.furrow.model.result.FieldResult;
import io.furrow.model.result.PresenceResult;

/**
 * Collects records of analytics, in any order: those of one encounter or stay are merged, and of a window the last one counts. A
 * newer epoch discards the results before it. Predictions, crossings, provisional results and reports of suspects are skipped.
 */
final class ResultCollector {
    private static final Set<String> PHASES =
            Set.of(CollisionResult.STARTED, CollisionResult.ONGOING, CollisionResult.ENDED);

    private final String mission;
    private final Map<String, Encounter> encounters = new HashMap<>();
    private final Map<String, Visit> visits = new HashMap<>();
    private final Map<Window, Average> averages = new HashMap<>();
    private long epoch;

    private record Window(ResultSubject subject, long start, long end) {}

    /** @param mission results of devices of other missions are skipped; null for all */
    ResultCollector(String mission) {
        this.mission = mission;
    }

    long epoch() {
        return epoch;
    }

    /** @param scope tenant and service path */
    void add(ResultKind kind, long ofEpoch, String scope, Entity entity) {
        if (ofEpoch < epoch) {
            return;
        }
        if (ofEpoch > epoch) {
            encounters.clear();
            visits.clear();
            averages.clear();
            epoch = ofEpoch;
        }
        switch (kind) {
            case ENCOUNTERS -> encounter(scope, entity);
            case AVERAGES -> average(scope, entity);
            case STAYS -> visit(scope, entity);
        }
    }

    List<AnalyticsResult> spans(ResultKind kind) {
        return new ArrayList<>(
                switch (kind) {
                    case ENCOUNTERS -> encounters.values();
                    case AVERAGES -> averages.values();
                    case STAYS -> visits.values();
                });
    }

    private void encounter(String scope, Entity entity) {
        String phase = entity.text(CollisionResult.PHASE).orElse("");
        if (!PHASES.contains(phase)
                || isOther(entity, CollisionResult.FIRST.mission())
                || isOther(entity, CollisionResult.SECOND.mission())) {
            return;
        }
        Optional<Long> start = time(entity, CollisionResult.START_TIME);
        Optional<Long> time = time(entity, CollisionResult.TIME);
        Optional<Double> closest = entity.number(CollisionResult.MIN_DISTANCE);
        if (start.isPresent() && time.isPresent() && closest.isPresent()) {
            String pair = entity.text(CollisionResult.FIRST.id()).orElse("?") + " – "
                    + entity.text(CollisionResult.SECOND.id()).orElse("?");
            String scopeOfSecond = entity.text(CollisionResult.SECOND.servicePath())
                    .map(path -> entity.text(CollisionResult.SECOND.service()).orElse("") + "|" + path + "|")
                    .orElse("");
            String types = entity.text(CollisionResult.FIRST.type()).orElse("") + " " + scopeOfSecond
                    + entity.text(CollisionResult.SECOND.type()).orElse("");
            encounters.merge(
                    entity.text(CollisionResult.ENCOUNTER).orElse(entity.id()),
                    new Encounter(
                            new ResultSubject(scope, types, pair),
                            start.get(),
                            time.get(),
                            !phase.equals(CollisionResult.ENDED),
                            closest.get()),
                    Encounter::and);
        }
    }

    private void visit(String scope, Entity entity) {
        Optional<Long> start = time(entity, PresenceResult.START_TIME);
        Optional<Long> time = time(entity, PresenceResult.TIME);
        if (start.isEmpty() || time.isEmpty() || isOther(entity, "Mission")) {
            return;
        }
        ResultSubject subject = new ResultSubject(
                scope,
                entity.text(PresenceResult.DEVICE_TYPE).orElse(""),
                entity.text(PresenceResult.DEVICE).orElse("?") + " in "
                        + entity.text(PresenceResult.FIELD).orElse("?"));
        boolean left = entity.text(PresenceResult.PHASE)
                .filter(PresenceResult.LEFT::equals)
                .isPresent();
        visits.merge(
                entity.text(PresenceResult.STAY).orElse(entity.id()),
                left ? new Visit(subject, start.get(), time.get(), false) : Visit.open(subject, start.get()),
                Visit::and);
    }

    private void average(String scope, Entity entity) {
        Optional<Long> start = time(entity, FieldResult.WINDOW_START);
        Optional<Long> end = time(entity, FieldResult.WINDOW_END);
        if (!entity.type().startsWith(FieldResult.TYPE_PREFIX) || start.isEmpty() || end.isEmpty()) {
            return;
        }
        String attribute = entity.type().substring(FieldResult.TYPE_PREFIX.length());
        ResultSubject subject =
                new ResultSubject(scope, "", entity.text(FieldResult.FIELD).orElse("?") + " " + attribute);
        Set<String> suspects = new HashSet<>();
        for (JsonNode suspect : entity.value(FieldResult.SUSPECTS).map(List::of).orElse(List.of())) {
            suspect.forEach(device -> suspects.add(device.asText()));
        }
        averages.put(
                new Window(subject, start.get(), end.get()),
                new Average(
                        subject,
                        start.get(),
                        end.get(),
                        entity.number(FieldResult.average(attribute)).orElse(Double.NaN),
                        suspects,
                        entity.text(FieldResult.QUALITY).orElse("")));
    }

    /** Whether the device states another mission. */
    private boolean isOther(Entity entity, String attribute) {
        return mission != null
                && entity.text(attribute).filter(one -> !one.equals(mission)).isPresent();
    }

    private static Optional<Long> time(Entity entity, String attribute) {
        return entity.number(attribute).map(Double::longValue);
    }
}
