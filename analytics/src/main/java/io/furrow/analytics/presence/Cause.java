package io.furrow.analytics.presence;

/** Why a device entered or left a field at an instant. */
public enum Cause {
    /** It reported another position at that instant. */
    MOVED("moved"),
    /** A version of the field has another area from then on; the device reported nothing at that instant. */
    FIELD_CHANGED("field-changed"),
    /** There is no field of that id from then on. */
    FIELD_REMOVED("field-removed"),
    /** Its position was as old as the time-to-live. */
    SILENT("silent");

    private final String code;

    Cause(String code) {
        this.code = code;
    }

    /** As messages have it. */
    public String code() {
        return code;
    }
}
