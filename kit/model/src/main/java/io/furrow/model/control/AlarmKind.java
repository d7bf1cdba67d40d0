package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonCreator;

import io.furrow.model.text.Coded;

/** The kinds of alarms. Names never change because clients depend on them. */
public enum AlarmKind implements Coded {
    /** Devices of a mission did not start within the timeout; the subject is the mission's entity. */
    MISSING_DEVICES,
    /**
     * Devices have not reported for longer than allowed; the subject is the entity of their mission, otherwise of their
     * domain.
     */
    SILENT_DEVICE,
    /**
     * So many devices of a mission are silent that its site or connection is probably unavailable; the subject is the
     * mission's entity.
     */
    SILENT_MISSION,
    /** No device reports; the subject is the topic without records. */
    SILENT_FARM,
    /**
     * Two devices are closer than allowed; the subject is the pair, {@code <idA>-<idB>}, or for several alarms their
     * mission's entity.
     */
    COLLISION,
    /**
     * Two devices are on courses that bring them too close; the subject is the pair, or for several alarms their
     * mission's entity.
     */
    PREDICTED_ENCOUNTER,
    /**
     * A sensor deviates from those around it; the subject is its entity, or for several alarms that of the field's
     * results.
     */
    SUSPECT_SENSOR,
    /**
     * A device's positions arrive too late; the subject is its entity, or for several alarms their mission's entity.
     */
    CLOCK_BEHIND,
    /** A part of Furrow fails or needs an operator; the subject is its name. */
    FAULT;

    /** @throws IllegalArgumentException if the code is unknown */
    @JsonCreator
    public static AlarmKind of(String code) {
        return Coded.find(values(), code)
                .orElseThrow(() -> new IllegalArgumentException("there is no alarm of kind '" + code + "'"));
    }
}
