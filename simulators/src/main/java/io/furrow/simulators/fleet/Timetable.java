package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.TreeSet;

import io.furrow.simulators.scenario.SimulatedDevice;

/**
 * Who reports when: each device once in its period, the devices of one period evenly spread over it. The times do not depend on
 * when they are taken; a device that is more than {@link #FORGIVEN} behind leaves out whole periods.
 */
final class Timetable {
    static final Duration FORGIVEN = Duration.ofSeconds(10);

    /** The golden ratio's part after the point: multiples of it are spread evenly, however many there are. */
    private static final double SPREAD = 0.6180339887498949;

    private final TreeSet<Due> queue = new TreeSet<>();
    private final Map<String, Due> next = new HashMap<>();
    private long added;

    /** A report that is due; of two at the same time the device that was added first comes first. */
    record Due(Instant time, long order, SimulatedDevice device) implements Comparable<Due> {
        @Override
        public int compareTo(Due other) {
            int byTime = time.compareTo(other.time);
            return byTime != 0 ? byTime : Long.compare(order, other.order);
        }
    }

    /** A device that reports within a period from a time on, and once in each period after that. */
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

    /** When the next report is due; empty where there is no device. */
    Optional<Instant> next() {
        return queue.isEmpty() ? Optional.empty() : Optional.of(queue.first().time());
    }

    /** Takes the next report that is due by a time. */
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
