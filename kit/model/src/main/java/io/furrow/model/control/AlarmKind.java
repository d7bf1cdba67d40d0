package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonCreator;

import io.furrow.model.text.Coded;

/** The kinds of alarms. Names never change because clients depend on them. */
public enum AlarmKind implements Coded {
    /** Devices of a mission did not start within the timeout; the subject is the mission's entity. */
    MISSING_DEVICES,
    /** Devices were silent for too long; the subject is the entity of their mission, else of their domain. */
    SILENT_DEVICE,
    /** So many devices are silent that their site is probably offline; the subject is the mission's entity. */
    SILENT_MISSION,
    /** No device reports; the subject is the topic without records. */
    SILENT_FARM,
    /** Two devices are too close; the subject is the pair {@code <idA>-<idB>}; for several, their mission's entity. */
    COLLISION,
    /** Two devices will come too close; the subject is the pair; for several, their mission's entity. */
    PREDICTED_ENCOUNTER,
    /** A sensor deviates from its neighbors; the subject is its entity; for several, that of the field's results. */
    SUSPECT_SENSOR,
    /** A device's positions arrive too late; the subject is its entity; for several, their mission's entity. */
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
