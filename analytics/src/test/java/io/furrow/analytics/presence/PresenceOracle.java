package io.furrow.analytics.presence;

import java.util.ArrayList;
import java.util.List;
import java.util.TreeSet;

import io.furrow.analytics.position.PositionFix;

/** The definition, millisecond by millisecond: no events, no timers, no state; for short stories only. */
final class PresenceOracle {
    private final List<PositionFix> fixes;
    private final List<Plot> plots;
    private final long timeToLive;
    private final long dwell;

    /** From {@code from} until {@code until}, exclusive. */
    private record Span(long from, long until) {}

    private PresenceOracle(List<PositionFix> fixes, List<Plot> plots, PresenceRules rules) {
        this.fixes = fixes;
        this.plots = plots;
        this.timeToLive = rules.timeToLive().toMillis();
        this.dwell = rules.dwell().toMillis();
    }

    /** One line per passage, sorted. */
    static List<String> passages(List<PositionFix> fixes, List<Plot> plots, PresenceRules rules) {
        List<String> lines = new ArrayList<>();
        for (String device : new TreeSet<>(fixes.stream().map(PositionFix::key).toList())) {
            List<PositionFix> own =
                    fixes.stream().filter(fix -> fix.key().equals(device)).toList();
            PresenceOracle oracle = new PresenceOracle(own, plots, rules);
            for (String field : new TreeSet<>(plots.stream().map(Plot::id).toList())) {
                oracle.tell(field, lines);
            }
        }
        lines.sort(null);
        return lines;
    }

    static String line(PresenceTransition passage) {
        Visit stay = passage.stay();
        return line(stay.fix(), stay.field(), passage.phase().code(), passage.time(), passage.emitted()) + " "
                + stay.cause().code() + " since " + stay.since();
    }

    private static String line(PositionFix fix, String field, String phase, long time, long told) {
        return "%s %s %s at %d told %d from %s,%s"
                .formatted(fix.key(), field, phase, time, told, fix.longitude(), fix.latitude());
    }

    private void tell(String field, List<String> lines) {
        Span stay = null;
        for (Span inside : spans(field)) {
            if (stay != null && inside.from() - stay.until() < dwell) {
                stay = new Span(stay.from(), inside.until());
                continue;
            }
            if (stay != null) {
                tellLeft(field, stay, lines);
                stay = null;
            }
            if (inside.until() - inside.from() >= dwell) {
                tellEntered(field, inside.from(), lines);
                stay = inside;
            }
        }
        if (stay != null) {
            tellLeft(field, stay, lines);
        }
    }

    private void tellEntered(String field, long time, List<String> lines) {
        String cause = reportedAt(time) ? "moved" : "field-changed";
        lines.add(line(newest(time), field, "entered", time, time + dwell) + " " + cause + " since " + time);
    }

    private void tellLeft(String field, Span stay, List<String> lines) {
        long time = stay.until();
        PositionFix newest = newest(time);
        String cause = reportedAt(time) ? "moved" : "field-changed";
        if (newest.time() + timeToLive <= time) {
            cause = "silent";
        }
        Plot plot = plot(field, time);
        if (plot == null || plot.parts().isEmpty()) {
            cause = "field-removed";
        }
        lines.add(line(newest, field, "left", time, time + dwell) + " " + cause + " since " + stay.from());
    }

    private List<Span> spans(String field) {
        long first = fixes.stream().mapToLong(PositionFix::time).min().orElseThrow();
        long last = fixes.stream().mapToLong(PositionFix::time).max().orElseThrow() + timeToLive + 1;
        List<Span> spans = new ArrayList<>();
        long from = -1;
        for (long time = first; time <= last; time++) {
            if (isInside(field, time) && from < 0) {
                from = time;
            } else if (!isInside(field, time) && from >= 0) {
                spans.add(new Span(from, time));
                from = -1;
            }
        }
        return spans;
    }

    private boolean isInside(String field, long time) {
        PositionFix fix = newest(time);
        Plot plot = plot(field, time);
        return plot != null && fix.time() + timeToLive > time && plot.covers(fix);
    }

    private boolean reportedAt(long time) {
        return fixes.stream().anyMatch(fix -> fix.time() == time);
    }

    private PositionFix newest(long time) {
        return fixes.stream()
                .filter(fix -> fix.time() <= time)
                .max(PositionFix.SEQUENCE)
                .orElseThrow();
    }

    private Plot plot(String field, long time) {
        Plot newest = null;
        for (Plot plot : plots) {
            if (plot.id().equals(field) && plot.validFrom() <= time) {
                newest = newest == null || plot.validFrom() >= newest.validFrom() ? plot : newest;
            }
        }
        return newest;
    }
}
