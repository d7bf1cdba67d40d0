package io.furrow.analytics.temperature.suspect;

/**
 * The windows in a row in which a device was set aside.
 *
 * @param windows how many, at least one
 * @param since start of the first, epoch ms
 * @param until end of the last, epoch ms
 * @param type of the device's entity; null in state of before types were told apart
 */
public record SuspectRun(int windows, long since, long until, String type) {
    /** After one more window in which the device was set aside; {@code before} is null if it was the first. */
    static SuspectRun after(SuspectRun before, Verdict suspect) {
        String type = before != null && suspect.type() == null ? before.type : suspect.type();
        return before == null
                ? new SuspectRun(1, suspect.windowStart(), suspect.windowEnd(), type)
                : new SuspectRun(before.windows + 1, before.since, suspect.windowEnd(), type);
    }
}
