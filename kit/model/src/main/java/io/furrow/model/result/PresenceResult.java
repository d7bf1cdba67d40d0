package io.furrow.model.result;

/** Names of entities on {@code data.presence}: a device entered a field or left it. */
public final class PresenceResult {
    public static final String TYPE = ResultTypes.PREFIX + "Presence";

    /** Id of the device's entity. */
    public static final String DEVICE = "device";
    /** Type of the device's entity. */
    public static final String DEVICE_TYPE = "deviceType";
    /** Id of the field. */
    public static final String FIELD = "field";
    /** Name of the field, if it has one. */
    public static final String FIELD_NAME = "fieldName";
    /** {@code entered} or {@link #LEFT}. */
    public static final String PHASE = "phase";

    public static final String LEFT = "left";
    /** Why the device is inside or outside of the field from then on. */
    public static final String CAUSE = "cause";
    /** Epoch ms. */
    public static final String TIME = "time";
    /** Epoch ms, when the device entered. */
    public static final String START_TIME = "startTime";
    /** Id of the visit, the same in all its records. */
    public static final String STAY = "stay";
    /** Milliseconds in the field, once it was left. */
    public static final String DWELL = "dwell";

    private PresenceResult() {}
}
