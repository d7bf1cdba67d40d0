package io.furrow.model.control;

/**
 * How large requests and records of the control plane may be, in bytes. Managers, REST API, topics and producers take their limits
 * from here, and the OpenAPI document states them.
 */
public final class Limits {
    /** Value of a request as it stands on the topic of its manager; a larger one is refused with {@link ErrorCode#TOO_LARGE}. */
    public static final int REQUEST_BYTES = 512 * 1024;

    /**
     * Key and value of a record that the control plane writes, to a topic or to the changelog of its state. A request grows by less
     * than the difference to {@link #REQUEST_BYTES} when defaults are filled in.
     */
    public static final int RECORD_BYTES = 900_000;

    /** {@code max.message.bytes} of the topics of the control plane: a record and what surrounds it in a batch. */
    public static final int MESSAGE_BYTES = 1024 * 1024;

    /** A dead letter carries the original record, which may be as large as any record on {@code data.*}. */
    public static final int DEAD_LETTER_BYTES = 16 * 1024 * 1024;

    /**
     * All definitions together, which are held in memory: domains, templates, missions with their device lists, {@link #DEVICE_BYTES}
     * for each device; and as much again for all replays.
     */
    public static final long DEFINITIONS_BYTES = 32L * 1024 * 1024;

    /** What a device of a mission counts for among the definitions, until its mission is deleted. */
    public static final int DEVICE_BYTES = 1024;

    /** What a mission counts for besides its list and its devices. */
    public static final int MISSION_OVERHEAD_BYTES = 1024;

    /** Ids of requests that one manager remembers; beyond it refuses further ones until the oldest are forgotten. */
    public static final int REMEMBERED_REQUESTS = 250_000;

    /** Kinds and subjects of alarms that are muted at one time. */
    public static final int MUTES = 10_000;

    /** Longest reason, in characters, that is kept of what an executor says. */
    public static final int REASON_LENGTH = 500;

    /** All parts of the device list of one mission together. */
    public static final int MISSION_BYTES = 4 * 1024 * 1024;

    private Limits() {}

    /** A reason, cut where it is longer than {@link #REASON_LENGTH}, its halves of surrogate pairs replaced; null stays null. */
    public static String reason(String reason) {
        if (reason == null) {
            return null;
        }
        int length = reason.codePointCount(0, reason.length());
        StringBuilder kept = new StringBuilder();
        reason.codePoints()
                .limit(length > REASON_LENGTH ? REASON_LENGTH - 1 : length)
                .map(sign -> sign >= Character.MIN_SURROGATE && sign <= Character.MAX_SURROGATE ? 0xfffd : sign)
                .forEach(kept::appendCodePoint);
        return length > REASON_LENGTH ? kept.append('…').toString() : kept.toString();
    }
}
