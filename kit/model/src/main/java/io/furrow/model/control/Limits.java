package io.furrow.model.control;

import io.furrow.model.text.Utf8;

/**
 * Size limits of requests and records of the control plane, in bytes. Managers, REST API, topics and producers use
 * them, and the OpenAPI document states them.
 */
public final class Limits {
    /** Maximum value of a request on its manager's topic; larger ones are rejected with {@link ErrorCode#TOO_LARGE}. */
    public static final int REQUEST_BYTES = 512 * 1024;

    /**
     * Maximum key and value of a record that the control plane writes, to a topic or a changelog. The difference to
     * {@link #REQUEST_BYTES} exceeds the growth of a request when defaults are added.
     */
    public static final int RECORD_BYTES = 900_000;

    /** {@code max.message.bytes} of the topics of the control plane: a record with the overhead of its batch. */
    public static final int MESSAGE_BYTES = 1024 * 1024;

    /** A dead letter contains the original record, which may be as large as any record on {@code data.*}. */
    public static final int DEAD_LETTER_BYTES = 16 * 1024 * 1024;

    /**
     * Maximum of all definitions, which are held in memory: domains, templates, missions with their device lists,
     * {@link #DEVICE_BYTES} for each device; the same again for all replays.
     */
    public static final long DEFINITIONS_BYTES = 32L * 1024 * 1024;

    /** Bytes that count for a device of a mission until the mission is deleted. */
    public static final int DEVICE_BYTES = 1024;

    /** Bytes that count for a mission in addition to its list and its devices. */
    public static final int MISSION_OVERHEAD_BYTES = 1024;

    /** Maximum request ids that a manager stores; it rejects further requests until the oldest ids expire. */
    public static final int REMEMBERED_REQUESTS = 250_000;

    /** Maximum mutes at one time. */
    public static final int MUTES = 10_000;

    /** Maximum characters of an executor's reason. */
    public static final int REASON_LENGTH = 500;

    /** Maximum of all parts of a mission's device list. */
    public static final int MISSION_BYTES = 4 * 1024 * 1024;

    private Limits() {}

    /** Truncates a reason to {@link #REASON_LENGTH} and replaces halves of surrogate pairs; null stays null. */
    public static String reason(String reason) {
        if (reason == null) {
            return null;
        }
        String text = Utf8.encodable(reason);
        return text.codePointCount(0, text.length()) <= REASON_LENGTH
                ? text
                : text.substring(0, text.offsetByCodePoints(0, REASON_LENGTH - 1)) + '…';
    }
}
