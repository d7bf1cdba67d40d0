package io.furrow.model.result;

/** Names of entities about the clocks of devices. */
public final class ClockResult {
    /** Type for a device whose clock is behind. */
    public static final String BEHIND_TYPE = ResultTypes.PREFIX + "ClockBehind";
    /** Type for the offset of a device's clock. */
    public static final String OFFSET_TYPE = ResultTypes.PREFIX + "ClockOffset";

    /** Id of the device. */
    public static final String DEVICE = "device";
    /** Type of its entity; empty if unknown. */
    public static final String DEVICE_TYPE = "deviceType";
    /** Milliseconds that positions of {@link #BEHIND_TYPE} arrived too late, or reports after their time. */
    public static final String LATE = "late";
    /** Number of reports of a {@link #BEHIND_TYPE} that were received long after their time. */
    public static final String REPORTS = "reports";
    /** Milliseconds after which the next {@link #BEHIND_TYPE} of the device is expected. */
    public static final String INTERVAL = "interval";

    private ClockResult() {}
}
