package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonCreator;

import io.furrow.model.text.Coded;

/** What alarms are about; the names are never changed, clients branch on them. */
public enum AlarmKind implements Coded {
    /** Devices of a mission did not come up within the start timeout; the subject is the mission's entity. */
    MISSING_DEVICES,
    /** Devices were not heard of for longer than they may be; the subject is the entity of their mission, else domain. */
    SILENT_DEVICE,
    /** So much of a mission is silent that rather its site or connection is unavailable; the subject is the mission's entity. */
    SILENT_MISSION,
    /** Nothing arrives from any device; the subject is the topic that nothing arrives on. */
    SILENT_FARM,
    /** Two devices are closer than they may be; the subject is the pair, {@code <idA>-<idB>}; of more, their mission's entity. */
    COLLISION,
    /** Two devices are on courses that bring them too close; the subject is the pair; of more, their mission's entity. */
    PREDICTED_ENCOUNTER,
    /** A sensor shows what those around it do not; the subject is its entity; of more, that of the field's results. */
    SUSPECT_SENSOR,
    /** A device's positions come too late to count; the subject is its entity; of more, their mission's entity. */
    CLOCK_BEHIND,
    /** A part of Furrow itself does not do its work, or needs somebody; the subject is its name. */
    FAULT;

    /** @throws IllegalArgumentException if there is none of that code */
    @JsonCreator
    public static AlarmKind of(String code) {
        return Coded.find(values(), code)
                .orElseThrow(() -> new IllegalArgumentException("there is no alarm of kind '" + code + "'"));
    }
}
