package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.TreeSet;

import io.furrow.simulators.scenario.SimulatedDevice;

/**
 * Schedules reports: each device once per period, the devices of one period evenly spread over it. Due times do not
 * depend on when they are taken; a device more than {@link #FORGIVEN} behind skips whole periods.
 */
final class ReportScheduler {
    static final Duration FORGIVEN = Duration.ofSeconds(10);

    /** The fraction of the golden ratio: its multiples are evenly spread, however many there are. */
    private static final double SPREAD = 0.6180339887498949;

    private final TreeSet<Due> queue = new TreeSet<>();
    private final Map<String, Due> next = new HashMap<>();
    private long added;

    /** A due report; at equal times the device added first comes first. */
    record Due(Instant time, long order, SimulatedDevice device) implements Comparable<Due> {
        @Override
        public int compareTo(Due other) {
            int byTime = time.compareTo(other.time);
            return byTime != 0 ? byTime : Long.compare(order, other.order);
        }
    }

    /** Adds a device that reports within a period from a time on, then once per period. */
    void add(SimulatedDevice device, Instant from) {
        remove(device.id());
        long order = added++;
        double phase = order * SPREAD % 1;
        put(new Due(from.plusNanos((long) (phase * device.period().toNanos())), order, device));
    }

    void remove(String device) {
        Due due = next.remove(device);
        if (due != null) {
            queue.remove(due);
        }
    }

    /** Time of the next report; empty without devices. */
    Optional<Instant> next() {
        return queue.isEmpty() ? Optional.empty() : Optional.of(queue.first().time());
    }

    /** Removes the next report due by a time. */
    Optional<Due> take(Instant now) {
        if (queue.isEmpty() || queue.first().time().isAfter(now)) {
            return Optional.empty();
        }
        Due due = queue.pollFirst();
        Duration period = due.device().period();
        Instant following = due.time().plus(period);
        Duration behind = Duration.between(following, now);
        if (behind.compareTo(FORGIVEN) > 0) {
            following = following.plus(period.multipliedBy(behind.dividedBy(period)));
        }
        put(new Due(following, due.order(), due.device()));
        return Optional.of(due);
    }

    private void put(Due due) {
        queue.add(due);
        next.put(due.device().id(), due);
    }
}
