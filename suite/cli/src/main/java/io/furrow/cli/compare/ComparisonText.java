package io.furrow.cli.compare;

import java.time.Duration;
import java.util.Collection;
import java.util.Locale;
import java.util.TreeSet;
import java.util.stream.Collectors;

import io.furrow.cli.compare.AnalyticsResult.Average;
import io.furrow.cli.compare.AnalyticsResult.Encounter;
import io.furrow.cli.time.Times;

/** Formats values of results for display. */
final class ComparisonText {
    private ComparisonText() {}

    /** For instance {@code 4.5 s}, {@code 3 min 05 s}, {@code 2 h 10 min}. */
    static String duration(long millis) {
        if (millis < 60_000) {
            return String.format(Locale.ROOT, millis % 1000 == 0 ? "%.0f s" : "%.1f s", millis / 1000.0);
        }
        Duration duration = Duration.ofMillis(millis);
        return duration.toHours() > 0
                ? String.format(Locale.ROOT, "%d h %02d min", duration.toHours(), duration.toMinutesPart())
                : String.format(Locale.ROOT, "%d min %02d s", duration.toMinutes(), duration.toSecondsPart());
    }

    /** The duration of a result, or that it is open. */
    static String length(AnalyticsResult span) {
        return span.isOpen() ? "open" : duration(span.end() - span.start());
    }

    /** The value of a result of one side. */
    private static String value(AnalyticsResult span) {
        if (span instanceof Encounter one) {
            return "closest " + number(one.closest()) + " m";
        } else if (span instanceof Average one) {
            return "mean " + (one.isEmpty() ? "none" : number(one.mean()));
        }
        return "";
    }

    /** For instance {@code closest 1.2 → 1.5 (+0.3)}, {@code end 3 s later}. */
    private static String change(MemberDifference change) {
        if (change.a() instanceof Long a && change.b() instanceof Long b) {
            return "%s %s %s".formatted(change.member(), duration(Math.abs(b - a)), b > a ? "later" : "earlier");
        }
        String text = "%s %s → %s".formatted(change.member(), text(change.a()), text(change.b()));
        return change.a() instanceof Double a && change.b() instanceof Double b
                ? text + String.format(Locale.ROOT, " (%s%s)", b > a ? "+" : "−", number(Math.abs(b - a)))
                : text;
    }

    /** Time, duration, side and content. */
    static String match(ResultMatch match) {
        String what = what(match);
        return "%s, %s, %s%s"
                .formatted(
                        Times.of(match.either().start()),
                        length(match.either()),
                        match.verdict().code(),
                        what.isEmpty() ? "" : ": " + what);
    }

    /** The changes, or the value of the result if only one side has it. */
    static String what(ResultMatch match) {
        return match.verdict() == ResultMatch.Verdict.CHANGED
                ? match.changes().stream().map(ComparisonText::change).collect(Collectors.joining(", "))
                : value(match.either());
    }

    private static String text(Object value) {
        if (value == null) {
            return "none";
        } else if (value instanceof Double number) {
            return number(number);
        } else if (value instanceof Collection<?> many) {
            TreeSet<String> sorted = new TreeSet<>();
            many.forEach(one -> sorted.add(one.toString()));
            return sorted.isEmpty() ? "none" : String.join(" ", sorted);
        }
        return value.toString();
    }

    /** To three decimal places, without trailing zeros. */
    static String number(double value) {
        return String.format(Locale.ROOT, "%.3f", value).replaceFirst("\\.?0+$", "");
    }
}
