package io.furrow.analytics.temperature.suspect;

/**
 * The windows in a row in which a device was set aside.
 *
 * @param windows how many, at least one
 * @param since start of the first, epoch ms
 * @param until end of the last, epoch ms
 */
public record SuspectRun(int windows, long since, long until) {
    /** After one more window in which the device was set aside; {@code before} is null if it was the first. */
    static SuspectRun after(SuspectRun before, Verdict suspect) {
        return before == null
                ? new SuspectRun(1, suspect.windowStart(), suspect.windowEnd())
                : new SuspectRun(before.windows + 1, before.since, suspect.windowEnd());
    }
}
