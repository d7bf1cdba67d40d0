package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

import com.fasterxml.jackson.annotation.JsonInclude;

import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.text.Counts;

/**
 * The actual state of a mission: stored, and a record of {@code service.missions.status} keyed by its name. The methods
 * form the life cycle; each returns the status after an event.
 *
 * @param since when it entered that state, epoch ms
 * @param sequence of the mission to which the status applies
 * @param devices number of its devices; after a stop, the number of simulated devices that have to stop
 * @param confirmed number of devices in the desired state: up while it starts or runs, stopped afterwards
 * @param missing at most {@value #MAX_NAMED} of the others, once the timeout has passed
 * @param reason why it failed, or which of its devices are not up; null if neither
 * @param due when the next timed transition is due, epoch ms; null if there is none
 * @param ends when it is stopped automatically, epoch ms; null if never
 */
public record MissionStatus(
        String mission,
        String domain,
        MissionState state,
        long since,
        long sequence,
        int devices,
        int confirmed,
        List<Missing> missing,
        String reason,
        Long due,
        Long ends)
        implements StateRecord {
    static final int MAX_NAMED = 100;

    /** Number of missing devices that {@link #reason} names. */
    public static final int MAX_EXPLAINED = 3;

    /**
     * A device that is not in the desired state.
     *
     * @param id of its entity
     * @param reason a sentence; null if unknown
     * @param code kind of reason; null if it has none
     * @param values names, numbers and times in the sentence, by name; times are epoch ms
     */
    public record Missing(
            String id,
            String reason,
            String code,
            @JsonInclude(JsonInclude.Include.NON_EMPTY) Map<String, String> values) {
        Missing(String id, String reason) {
            this(id, reason, null, null);
        }
    }

    static MissionStatus created(Mission mission, long now) {
        return new MissionStatus(
                mission.mission(),
                mission.domain(),
                MissionState.CREATED,
                now,
                mission.sequence(),
                0,
                0,
                List.of(),
                null,
                null,
                null);
    }

    /** Its list of devices has changed. */
    MissionStatus listed(Mission changed) {
        return new MissionStatus(
                mission, domain, state, since, changed.sequence(), devices, confirmed, missing, reason, due, ends);
    }

    MissionStatus scheduled(Mission mission, long now) {
        return next(MissionState.CREATED, now, mission.sequence())
                .progress(0, 0)
                .until(mission.start(), null);
    }

    /** Its devices were requested. Without devices it runs immediately. */
    MissionStatus started(Mission mission, int desired, long timeout, long now) {
        Long end = mission.duration() == null ? null : Long.valueOf(now + mission.duration());
        MissionStatus starting = next(MissionState.STARTING, now, mission.sequence())
                .progress(desired, 0)
                .until(earlier(now + timeout, end), end);
        return starting.advanced(now);
    }

    /** Its devices are requested to stop. Without simulated ones it is stopped immediately. */
    MissionStatus stopped(Mission mission, int simulated, long timeout, long now) {
        MissionState next = state == MissionState.CREATED ? MissionState.STOPPED : MissionState.STOPPING;
        boolean stops = next == MissionState.STOPPING;
        return next(next, now, mission.sequence())
                .progress(stops ? simulated : 0, 0)
                .until(stops ? Long.valueOf(now + timeout) : null, null)
                .advanced(now);
    }

    /** It could not start; its devices, if any were requested, are no longer desired. */
    MissionStatus failed(Mission undesired, String why, long now) {
        MissionStatus failed = next(MissionState.FAILED, now, undesired.sequence());
        return new MissionStatus(
                mission, domain, failed.state, now, failed.sequence, devices, 0, List.of(), why, null, null);
    }

    /** One of its devices entered or left the desired state. */
    MissionStatus reported(Missing device, boolean asDesired, long now) {
        boolean late = state == MissionState.RUNNING || !missing.isEmpty();
        List<Missing> named = new ArrayList<>(missing);
        named.removeIf(existing -> existing.id().equals(device.id()));
        if (!asDesired && late && named.size() < MAX_NAMED) {
            named.add(device);
        }
        MissionStatus after = progress(devices, confirmed + (asDesired ? 1 : -1));
        return state == MissionState.STARTING && late && asDesired
                ? after.without(named, now)
                : after.withMissing(named).advanced(now);
    }

    /** The reason why one of its devices is not in the desired state changed. */
    MissionStatus explained(Missing device) {
        return withMissing(missing.stream()
                .map(existing -> existing.id().equals(device.id()) ? device : existing)
                .toList());
    }

    /**
     * The timeout for starting or stopping has passed. It proceeds without the late devices, except that a start waits
     * until at least one device is up. Late devices may still come up.
     */
    MissionStatus without(List<Missing> late, long now) {
        boolean starts = state == MissionState.STARTING;
        if (starts && confirmed == 0 && devices > 0) {
            return until(ends, ends).withMissing(late);
        }
        MissionStatus next = next(starts ? MissionState.RUNNING : MissionState.STOPPED, now, sequence);
        return next.until(starts ? ends : null, starts ? ends : null).withMissing(late);
    }

    /** All of its devices were written: the timeout for starting or stopping begins. */
    MissionStatus written(long timeout, long now) {
        boolean waits = state == MissionState.STARTING || state == MissionState.STOPPING;
        return waits ? until(earlier(now + timeout, ends), ends) : this;
    }

    /**
     * Returns the status as if its state had begun now, if a clock that was ahead says later; the same instance
     * otherwise. A start date is absolute and stays.
     */
    MissionStatus notAfter(long now) {
        if (since <= now || due == null || state == MissionState.CREATED) {
            return this;
        }
        return new MissionStatus(
                mission,
                domain,
                state,
                now,
                sequence,
                devices,
                confirmed,
                missing,
                reason,
                due - since + now,
                ends == null ? null : Long.valueOf(ends - since + now));
    }

    boolean isDue(long now) {
        return due != null && due <= now;
    }

    /** Proceeds to the next state if all devices are in the desired state. */
    private MissionStatus advanced(long now) {
        if (confirmed < devices || state != MissionState.STARTING && state != MissionState.STOPPING) {
            return this;
        }
        return without(List.of(), now);
    }

    private MissionStatus next(MissionState next, long now, long newSequence) {
        if (!state.canBecome(next)) {
            throw new IllegalStateException("mission %s cannot become %s: it is %s".formatted(mission, next, state));
        }
        return new MissionStatus(
                mission, domain, next, now, newSequence, devices, confirmed, List.of(), null, due, ends);
    }

    private MissionStatus progress(int newDevices, int newConfirmed) {
        return new MissionStatus(
                mission, domain, state, since, sequence, newDevices, newConfirmed, missing, reason, due, ends);
    }

    private MissionStatus until(Long newDue, Long newEnds) {
        return new MissionStatus(
                mission, domain, state, since, sequence, devices, confirmed, missing, reason, newDue, newEnds);
    }

    private MissionStatus withMissing(List<Missing> named) {
        boolean up = state == MissionState.STARTING || state == MissionState.RUNNING;
        String why = named.isEmpty() || !up ? null : why(named);
        return new MissionStatus(
                mission, domain, state, since, sequence, devices, confirmed, List.copyOf(named), why, due, ends);
    }

    private String why(List<Missing> named) {
        int unavailable = devices - confirmed;
        String some = named.stream()
                .limit(MAX_EXPLAINED)
                .map(each -> "%s (%s)".formatted(each.id(), each.reason()))
                .collect(Collectors.joining(", "));
        return "%s not up: %s%s"
                .formatted(
                        Counts.areOf(unavailable, devices, "device", ""),
                        some,
                        unavailable > MAX_EXPLAINED ? " and " + (unavailable - MAX_EXPLAINED) + " more" : "");
    }

    private static Long earlier(long one, Long other) {
        return other == null ? Long.valueOf(one) : Long.valueOf(Math.min(one, other));
    }
}
