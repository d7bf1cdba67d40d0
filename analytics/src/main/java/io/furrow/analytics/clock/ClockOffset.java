package io.furrow.analytics.clock;

import java.time.Duration;
import java.util.Arrays;
import java.util.Objects;

/**
 * The offset of a device's clock, estimated from its delays: receipt less event time. The delay of a message without latency is the
 * offset; no message can arrive earlier. The offset is therefore a minimum: the third least delay, which tolerates two wrong times,
 * of the previous and the current span. It falls at once, and rises only at the end of a span in which every message but two was
 * that late and no three later ones were earlier: a backlog that a gateway sends at once has no effect unless that takes longer than
 * a span.
 *
 * @param type of the entity; empty if unknown, as in state that was stored without it
 * @param millis the offset in force, which is added to the device's times; 0 for none
 * @param since the receipt that began the current span
 * @param before the three least delays of the previous span, ascending; {@link #UNKNOWN} for missing ones
 * @param least the same of the current span
 */
public record ClockOffset(String type, long millis, long since, long[] before, long[] least) {
    static final long SPAN = Duration.ofMinutes(2).toMillis();
    /** A smaller offset is attributed to latency, not to the clock. */
    static final long MIN = Duration.ofSeconds(1).toMillis();
    /** A greater one is attributed to a wrong time zone or date, not to drift. */
    static final long GREATEST = Duration.ofMinutes(10).toMillis();
    /** A new offset must differ by this much to replace the one in force. */
    static final long STEP = 250;

    private static final long UNKNOWN = Long.MAX_VALUE;
    private static final long[] NONE = {UNKNOWN, UNKNOWN, UNKNOWN};

    public ClockOffset {
        type = type == null ? "" : type;
    }

    /** The offset after the first message of a device. */
    static ClockOffset first(long time, long receipt) {
        return new ClockOffset("", 0, receipt, NONE, with(NONE, receipt - time));
    }

    /**
     * The offset after another message.
     *
     * @param time its event time by the device's clock, epoch ms
     * @param receipt epoch ms
     */
    ClockOffset after(long time, long receipt) {
        boolean over = receipt - since >= SPAN && third(least) != UNKNOWN;
        long[] last = over ? least : before;
        long[] now = with(over ? NONE : least, receipt - time);
        long newMillis = third(now) == UNKNOWN ? millis : inForce(learned(last, now));
        return new ClockOffset(type, newMillis, over ? receipt : since, last, now);
    }

    ClockOffset of(String newType) {
        return new ClockOffset(newType, millis, since, before, least);
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof ClockOffset that
                && type.equals(that.type)
                && millis == that.millis
                && since == that.since
                && Arrays.equals(before, that.before)
                && Arrays.equals(least, that.least);
    }

    @Override
    public int hashCode() {
        return Objects.hash(type, millis, since, Arrays.hashCode(before), Arrays.hashCode(least));
    }

    /** The device's time as a correct clock shows it; not after its receipt, unless it is corrected backwards. */
    long corrected(long time, long receipt) {
        return millis <= 0 ? time + millis : Math.min(time + millis, Math.max(time, receipt));
    }

    private static long learned(long[] last, long[] now) {
        return third(last) == UNKNOWN ? Math.min(0, third(now)) : Math.min(third(last), third(now));
    }

    private long inForce(long learned) {
        boolean isClock = Math.abs(learned) >= MIN && Math.abs(learned) <= GREATEST;
        long target = isClock ? learned : 0;
        return target != 0 && millis != 0 && Math.abs(target - millis) < STEP ? millis : target;
    }

    private static long third(long[] ascending) {
        return ascending[2];
    }

    private static long[] with(long[] ascending, long delay) {
        if (delay >= third(ascending)) {
            return ascending;
        }
        long[] all = {ascending[0], ascending[1], delay};
        Arrays.sort(all);
        return all;
    }
}
