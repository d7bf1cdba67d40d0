package io.furrow.model.control;

import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;

/** What alarms are about; the names are never changed, clients branch on them. */
public enum AlarmKind {
    /** A device was not heard of for longer than it may be; the subject is its entity. */
    SILENT_DEVICE,
    /** Two devices are closer than they may be; the subject is the pair, {@code <idA>-<idB>}. */
    COLLISION,
    /** Two devices are on courses that bring them too close; the subject is the pair. */
    PREDICTED_ENCOUNTER,
    /** A sensor shows what those around it do not; the subject is its entity. */
    SUSPECT_SENSOR;

    /** The name in lower case with hyphens, for instance {@code silent-device}. */
    @JsonValue
    public String code() {
        return name().toLowerCase(Locale.ROOT).replace('_', '-');
    }

    /** @throws IllegalArgumentException where there is none of that code */
    @JsonCreator
    public static AlarmKind of(String code) {
        for (AlarmKind kind : values()) {
            if (kind.code().equals(code)) {
                return kind;
            }
        }
        throw new IllegalArgumentException("there is no alarm of kind '" + code + "'");
    }
}
