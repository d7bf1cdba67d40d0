package io.furrow.analytics.presence;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.stream.Collectors;

import io.furrow.analytics.field.Field;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.position.PositionFix;

/**
 * Follows one device through the fields: whenever it reports, falls silent, or any field changes, determines which fields cover
 * it. Entering and leaving count after the dwell, {@code [t, t + dwell)} without interruption.
 */
final class PresenceTracker implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final long NEVER = Long.MAX_VALUE;

    private final long timeToLive;
    private final long dwell;

    PresenceTracker(PresenceRules rules) {
        timeToLive = rules.timeToLive().toMillis();
        dwell = rules.dwell().toMillis();
    }

    /**
     * The presence after all positions of one device up to an instant.
     *
     * @param due in the order of {@link PositionFix#SEQUENCE}, none later than {@code until}
     * @param out receives the transitions in the order of the times at which they are certain
     */
    PresenceState advance(
            PresenceState from,
            List<PositionFix> due,
            long until,
            FieldVersions fields,
            Consumer<PresenceTransition> out) {
        PresenceState now = from;
        int next = 0;
        while (true) {
            long reported = next < due.size() ? due.get(next).time() : NEVER;
            long time = Math.min(reported, nextInstant(now, fields));
            if (time > until || time == NEVER) {
                return now;
            }
            PositionFix fix = null;
            while (next < due.size() && due.get(next).time() == time) {
                fix = due.get(next++);
            }
            now = at(now, time, fix, fields, out);
        }
    }

    /** The next instant, after those evaluated, that can cause a transition without a new position. */
    long nextInstant(PresenceState now, FieldVersions fields) {
        long next = now.stays().stream()
                .mapToLong(stay -> stay.deadline(dwell))
                .min()
                .orElse(NEVER);
        if (now.last() == null) {
            return next;
        }
        long change = fields.nextChange(now.judged()).orElse(NEVER);
        return Math.min(Math.min(next, change), now.last().time() + timeToLive);
    }

    /** Evaluates the device again, at an instant not before the last: a late version takes effect now. */
    PresenceState again(PresenceState now, long time, FieldVersions fields, Consumer<PresenceTransition> out) {
        return now.last() == null ? now : at(now, time, null, fields, out);
    }

    private PresenceState at(
            PresenceState before, long time, PositionFix fix, FieldVersions fields, Consumer<PresenceTransition> out) {
        PositionFix known = fix == null ? before.last() : fix;
        boolean silent = known == null || known.time() + timeToLive <= time;
        Map<String, Field> covering = silent
                ? new HashMap<>()
                : fields.covering(known.position(), time).stream()
                        .collect(Collectors.toMap(Field::id, Function.identity()));
        List<Visit> stays = new ArrayList<>();
        for (Visit stay : emitted(before.stays(), time, out)) {
            if (covering.remove(stay.field()) != null) {
                stays.add(stay.isInside() ? stay : stay.back());
            } else if (!stay.isInside()) {
                stays.add(stay);
            } else if (stay.emitted()) {
                Cause cause = whyOut(fields.at(stay.field(), time).isEmpty(), silent, fix != null);
                stays.add(stay.leaving(time, cause, known));
            }
        }
        Cause whyIn = fix != null ? Cause.MOVED : Cause.FIELD_CHANGED;
        covering.values().stream()
                .sorted(Comparator.comparing(Field::id))
                .map(field ->
                        new Visit(field.id(), field.name(), field.domain(), time, false, Visit.INSIDE, whyIn, known))
                .forEach(stays::add);
        return new PresenceState(silent ? null : known, time, emitted(stays, time, out));
    }

    private static Cause whyOut(boolean removed, boolean silent, boolean moved) {
        if (removed) {
            return Cause.FIELD_REMOVED;
        }
        if (silent) {
            return Cause.SILENT;
        }
        return moved ? Cause.MOVED : Cause.FIELD_CHANGED;
    }

    /** Emits the transitions that are certain at an instant; returns the visits that are not over. */
    private List<Visit> emitted(List<Visit> stays, long time, Consumer<PresenceTransition> out) {
        List<Visit> kept = new ArrayList<>();
        for (Visit stay : stays) {
            long deadline = stay.deadline(dwell);
            if (deadline > time) {
                kept.add(stay);
            } else if (stay.isInside()) {
                out.accept(new PresenceTransition(PresenceTransition.Phase.ENTERED, stay, deadline));
                kept.add(stay.entered());
            } else {
                out.accept(new PresenceTransition(PresenceTransition.Phase.LEFT, stay, deadline));
            }
        }
        return kept;
    }
}
