package io.furrow.control.alarm;

import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonValue;

import io.furrow.model.control.AlarmKind;

/** Severity of an alarm, in the terms of ITU-T X.733. */
public enum Severity {
    CRITICAL,
    MAJOR,
    MINOR,
    WARNING;

    static Severity of(AlarmKind kind) {
        return switch (kind) {
            case COLLISION, SILENT_FARM -> CRITICAL;
            case PREDICTED_ENCOUNTER, SILENT_MISSION, MISSING_DEVICES, CLOCK_BEHIND, FAULT -> MAJOR;
            case SILENT_DEVICE -> MINOR;
            case SUSPECT_SENSOR -> WARNING;
        };
    }

    /** The value in records. */
    @JsonValue
    public String code() {
        return name().toLowerCase(Locale.ROOT);
    }
}
