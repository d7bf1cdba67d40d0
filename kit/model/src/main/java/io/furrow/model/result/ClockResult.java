package io.furrow.model.result;

/** Entities about the clocks of devices. */
public final class ClockResult {
    /** A device whose clock is behind. */
    public static final String BEHIND_TYPE = ResultTypes.PREFIX + "ClockBehind";
    /** How far the clock of a device is off. */
    public static final String OFFSET_TYPE = ResultTypes.PREFIX + "ClockOffset";

    /** Id of the device. */
    public static final String DEVICE = "device";
    /** Type of its entity; empty where it is not known. */
    public static final String DEVICE_TYPE = "deviceType";
    /** Milliseconds that positions of {@link #BEHIND_TYPE} arrived too late, or reports after their time. */
    public static final String LATE = "late";
    /** How many reports of a {@link #BEHIND_TYPE} were received long after their time. */
    public static final String REPORTS = "reports";

    private ClockResult() {}
}
