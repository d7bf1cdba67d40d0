package io.furrow.control.context;

import java.util.List;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.control.domain.Domain;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionState;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/**
 * Builds the entities of domains and missions, {@code urn:ngsi-ld:Domain:<name>} and
 * {@code urn:ngsi-ld:Mission:<name>}. An entity always has all of its attributes, null if there is no value, so that no
 * stale value remains. It contains counts instead of lists, so that it stays small whatever a mission holds.
 */
final class ContextEntity {
    private static final String DOMAIN = "Domain";
    private static final String MISSION = "Mission";

    private ContextEntity() {}

    static String domainId(String domain) {
        return "urn:ngsi-ld:Domain:" + domain;
    }

    static String typeOf(String id) {
        return id.startsWith(domainId("")) ? DOMAIN : MISSION;
    }

    static String missionId(String mission) {
        return "urn:ngsi-ld:Mission:" + mission;
    }

    /**
     * @param missions number of missions in the domain
     * @param fields states of its fields
     */
    static EntityBuilder of(Domain domain, int missions, List<FieldState> fields) {
        EntityBuilder entity = Entity.builder(domainId(domain.domain()), DOMAIN);
        entity.freeText(
                "name",
                domain.details().name() == null
                        ? domain.domain()
                        : domain.details().name());
        entity.freeText("description", domain.details().description());
        entity.integer(
                        "fieldCount",
                        domain.details().fields() == null
                                ? 0
                                : domain.details().fields().size())
                .integer("missionCount", missions);
        number(
                entity,
                "averageTemperature",
                fields.stream()
                        .filter(field -> field.average() != null)
                        .mapToDouble(FieldState::average)
                        .average()
                        .stream()
                        .boxed()
                        .findFirst()
                        .orElse(null));
        TreeSet<String> suspects = new TreeSet<>();
        fields.forEach(field -> suspects.addAll(field.suspects()));
        return entity.integer("suspectCount", suspects.size())
                .integer("created", domain.created())
                .integer("changed", domain.changed());
    }

    /** @param status null if not known yet */
    static EntityBuilder of(Mission mission, MissionStatus status, MissionCounts counts) {
        EntityBuilder entity = Entity.builder(missionId(mission.mission()), MISSION)
                .text("name", mission.mission())
                .text("domain", mission.domain())
                .text("status", status == null ? "created" : status.state().code())
                .number("progress", status == null ? 0 : progress(status));
        entity.integer("deviceCount", mission.deviceCount()).integer("missingCount", missing(status));
        entity.freeText("reason", status == null ? null : status.reason());
        entity.freeText("template", mission.template());
        time(entity, "start", mission.start());
        time(entity, "end", status == null ? null : status.ends());
        entity.integer("collisions", counts.collisions())
                .integer("openEncounters", counts.open().size());
        number(entity, "minDistance", counts.minDistance());
        return entity;
    }

    /** Fraction of its devices that are confirmed; 1 if it has none. */
    private static double progress(MissionStatus status) {
        return status.devices() == 0 ? 1 : (double) status.confirmed() / status.devices();
    }

    /** Number of devices that are not confirmed; 0 unless the mission runs. */
    private static int missing(MissionStatus status) {
        boolean runs = status != null && status.state() == MissionState.RUNNING;
        return runs ? status.devices() - status.confirmed() : 0;
    }

    private static void number(EntityBuilder entity, String name, Double value) {
        entity.attribute(name, "Float", JsonNodeFactory.instance.numberNode(value));
    }

    private static void time(EntityBuilder entity, String name, Long value) {
        entity.attribute(name, "Integer", JsonNodeFactory.instance.numberNode(value));
    }
}
