package io.furrow.analytics.presence;

/** The cause of a device's entry into or exit from a field. */
public enum Cause {
    /** It reported another position at that instant. */
    MOVED("moved"),
    /** A version of the field has another area from then on; the device reported nothing at that instant. */
    FIELD_CHANGED("field-changed"),
    /** No field of that id exists from then on. */
    FIELD_REMOVED("field-removed"),
    /** Its position reached the time-to-live. */
    SILENT("silent");

    private final String code;

    Cause(String code) {
        this.code = code;
    }

    /** The code in messages. */
    public String code() {
        return code;
    }
}
