package io.furrow.control.alarm;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.text.Coded;

/** Severity of an alarm, in the terms of ITU-T X.733. */
public enum Severity implements Coded {
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
}
