package io.furrow.cli.compare;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

import io.furrow.cli.compare.ResultMatch.Verdict;
import io.furrow.cli.time.Times;

/** Writes a comparison as lines of text: the number of equal results of each kind, and a line for each difference. */
final class ComparisonTable {
    private static final String ROW = "  %-9s  %-20s  %-12s  %s  %s";

    private final int max;

    /** @param max lines of each kind */
    ComparisonTable(int max) {
        this.max = max;
    }

    List<String> lines(Comparison comparison) {
        List<String> lines = new ArrayList<>();
        lines.add("A  " + side(comparison.a()));
        lines.add("B  " + side(comparison.b()));
        for (ResultKind kind : ResultKind.values()) {
            lines.add("");
            kind(comparison, kind, lines);
        }
        lines.add("");
        lines.add(comparison.isSame() ? "A and B are the same." : "A and B differ.");
        return lines;
    }

    private static String side(SideResults side) {
        String name = side.name().equals(Side.LIVE) ? Side.LIVE : side.name() + ", epoch " + side.epoch();
        return side.missing().isEmpty()
                ? name
                : name + "; no topic of "
                        + side.missing().stream().sorted().map(ResultKind::code).collect(Collectors.joining(", "))
                        + ": nothing was found, or the job did not run";
    }

    private void kind(Comparison comparison, ResultKind kind, List<String> lines) {
        String title = kind.code().toUpperCase(Locale.ROOT);
        if (comparison.isUnknown(kind)) {
            lines.add(title + "  none on either side");
            return;
        }
        lines.add(title
                + "  "
                + List.of(Verdict.values()).stream()
                        .map(verdict -> comparison.count(kind, verdict) + " " + verdict.code())
                        .collect(Collectors.joining(", ")));
        List<ResultMatch> differences = comparison.differences(kind);
        int width = differences.stream()
                .limit(max)
                .mapToInt(match -> match.subject().name().length())
                .max()
                .orElse(0);
        differences.stream().limit(max).map(match -> row(match, width)).forEach(lines::add);
        if (differences.size() > max) {
            lines.add("  … and %d more; --limit shows more".formatted(differences.size() - max));
        }
    }

    private static String row(ResultMatch match, int width) {
        String name = match.subject().name();
        return String.format(
                        Locale.ROOT,
                        ROW,
                        match.verdict().code(),
                        Times.of(match.either().start()),
                        ComparisonText.length(match.either()),
                        name + " ".repeat(width - name.length()),
                        ComparisonText.what(match))
                .stripTrailing();
    }
}
