package io.furrow.cli.compare.report;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Predicate;
import java.util.stream.Stream;

import io.furrow.cli.compare.Average;
import io.furrow.cli.compare.Comparison;
import io.furrow.cli.compare.Match;
import io.furrow.cli.compare.Match.Verdict;
import io.furrow.cli.compare.ResultKind;
import io.furrow.cli.compare.Span;
import io.furrow.cli.compare.Subject;

/**
 * A comparison as a picture over time: for each pair, field and device a lane of A above one of B. What is the same is pale, what
 * differs has the color of its side, and a dashed outline stands where the other side has nothing. Averages are two curves, with a
 * mark behind each window that differs. Lanes with differences come first in each kind; lanes without any are left out beyond
 * {@value #MAX_LANES}.
 */
public final class ComparisonSvg {
    static final int MAX_LANES = 40;

    private static final int WIDTH = 1120;
    private static final int LEFT = 300;
    private static final int RIGHT = 24;
    private static final int TOP = 118;
    private static final int TITLE = 34;
    private static final int TICKS = 6;

    private static final String STYLE = """
            <style>
            .page { fill: #ffffff } .text { fill: #17211b } .muted { fill: #56665b } .grid { stroke: #d9e0d6 } .lane { fill: #f4f7f2 }
            .a { fill: #0b5cad } .b { fill: #b25a00 } .same { fill: #a9b8ad } .gap { fill: none; stroke: #b3261e; stroke-dasharray: 3 2 }
            .mark { fill: #b3261e; fill-opacity: .16 } .la { stroke: #0b5cad } .lb { stroke: #b25a00; stroke-dasharray: 5 3 }
            .curve { fill: none; stroke-width: 1.6; stroke-linejoin: round } .strong { font-weight: 600 }
            @media (prefers-color-scheme: dark) {
              .page { fill: #151d19 } .text { fill: #e8f0ea } .muted { fill: #9fb2a6 } .grid { stroke: #2b3831 } .lane { fill: #1b2520 }
              .a { fill: #6db7ff } .b { fill: #ffb638 } .same { fill: #4d5f54 } .gap { stroke: #ff7a6b } .mark { fill: #ff7a6b }
              .la { stroke: #6db7ff } .lb { stroke: #ffb638 }
            }
            </style>
            """;

    private final Comparison comparison;
    private final TimeScale scale;
    private final StringBuilder svg = new StringBuilder();
    private int y = TOP;

    private ComparisonSvg(Comparison comparison) {
        this.comparison = comparison;
        this.scale = TimeScale.of(comparison, LEFT, WIDTH - RIGHT);
    }

    public static String of(Comparison comparison) {
        return new ComparisonSvg(comparison).draw();
    }

    private String draw() {
        for (ResultKind kind : ResultKind.values()) {
            kind(kind);
        }
        int height = y + 24;
        String body = svg.toString();
        svg.setLength(0);
        svg.append("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" role=\"img\" "
                        .formatted(WIDTH, height))
                .append("font-family=\"system-ui, sans-serif\" font-size=\"12\">\n")
                .append("<title>")
                .append(escaped(title()))
                .append("</title>\n")
                .append(STYLE);
        add("<rect class=\"page\" width=\"%d\" height=\"%d\" rx=\"8\"/>", WIDTH, height);
        header(height);
        return svg.append(body).append("</svg>\n").toString();
    }

    private String title() {
        return comparison.a().name() + " and " + comparison.b().name();
    }

    private void header(int height) {
        add("<text class=\"text strong\" x=\"24\" y=\"34\" font-size=\"17\">%s</text>", escaped(title()));
        add(
                "<text class=\"muted\" x=\"24\" y=\"54\">%s</text>",
                comparison.isSame() ? "Analytics found the same in both." : "What analytics found differs.");
        int x = 24;
        x = legend("a", "only in A, or as A has it: " + comparison.a().name(), x);
        x = legend("b", "only in B, or as B has it: " + comparison.b().name(), x);
        x = legend("same", "the same", x);
        legend("gap", "missing", x);
        for (int i = 0; i <= TICKS; i++) {
            double at = LEFT + i * (double) (WIDTH - RIGHT - LEFT) / TICKS;
            add("<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"104\" y2=\"%d\"/>", at, at, height - 20);
            add(
                    "<text class=\"muted\" x=\"%.1f\" y=\"98\" text-anchor=\"%s\">%s</text>",
                    at, i == 0 ? "start" : i == TICKS ? "end" : "middle", scale.label(at));
        }
    }

    private int legend(String style, String text, int x) {
        add("<rect class=\"%s\" x=\"%d\" y=\"66\" width=\"14\" height=\"8\" rx=\"2\"/>", style, x);
        add("<text class=\"text\" x=\"%d\" y=\"74\">%s</text>", x + 20, escaped(text));
        return x + 44 + (int) (text.length() * 6.3);
    }

    private void kind(ResultKind kind) {
        Map<Subject, List<Match>> bySubject = new TreeMap<>();
        comparison
                .matches()
                .get(kind)
                .forEach(match -> bySubject
                        .computeIfAbsent(match.subject(), none -> new ArrayList<>())
                        .add(match));
        if (bySubject.isEmpty()) {
            return;
        }
        add(
                "<text class=\"text strong\" x=\"24\" y=\"%d\">%s</text><text class=\"muted\" x=\"%d\" y=\"%d\">%s</text>",
                y + 20, upper(kind.word()), LEFT, y + 20, counts(kind));
        y += TITLE;
        Predicate<Map.Entry<Subject, List<Match>>> differs =
                lane -> lane.getValue().stream().anyMatch(match -> match.verdict() != Verdict.SAME);
        List<Map.Entry<Subject, List<Match>>> lanes = Stream.concat(
                        bySubject.entrySet().stream().filter(differs),
                        bySubject.entrySet().stream().filter(differs.negate()))
                .toList();
        lanes.stream().limit(MAX_LANES).forEach(lane -> lane(kind, lane.getKey(), lane.getValue()));
        if (lanes.size() > MAX_LANES) {
            add(
                    "<text class=\"muted\" x=\"24\" y=\"%d\">and %d more, %d of them with differences</text>",
                    y + 12,
                    lanes.size() - MAX_LANES,
                    lanes.stream().skip(MAX_LANES).filter(differs).count());
            y += 22;
        }
        y += 8;
    }

    private String counts(ResultKind kind) {
        return "%d same, %d changed, %d only in A, %d only in B"
                .formatted(
                        comparison.count(kind, Verdict.SAME),
                        comparison.count(kind, Verdict.CHANGED),
                        comparison.count(kind, Verdict.ONLY_A),
                        comparison.count(kind, Verdict.ONLY_B));
    }

    private void lane(ResultKind kind, Subject subject, List<Match> matches) {
        int height = kind == ResultKind.AVERAGES ? 52 : 28;
        add(
                "<g><title>%s</title><text class=\"text\" x=\"24\" y=\"%d\">%s</text></g>",
                escaped(subject.name()), y + height / 2 + 4, escaped(shortened(subject.name())));
        add(
                "<rect class=\"lane\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"3\"/>",
                LEFT, y, WIDTH - RIGHT - LEFT, height);
        if (kind == ResultKind.AVERAGES) {
            curves(matches, height);
        } else {
            matches.forEach(this::bars);
        }
        y += height + 6;
    }

    private void bars(Match match) {
        boolean same = match.verdict() == Verdict.SAME;
        bar(match.a() == null ? match.b() : match.a(), match.a() == null ? "gap" : same ? "same" : "a", y + 4, match);
        bar(match.b() == null ? match.a() : match.b(), match.b() == null ? "gap" : same ? "same" : "b", y + 15, match);
    }

    private void bar(Span span, String style, int at, Match match) {
        double from = scale.x(span.start());
        double to = Math.max(from + 2, span.isOpen() ? WIDTH - RIGHT : scale.x(span.end()));
        add(
                "<rect class=\"%s\" x=\"%.1f\" y=\"%d\" width=\"%.1f\" height=\"9\" rx=\"2\"><title>%s</title></rect>",
                style, from, at, to - from, escaped(tip(match)));
    }

    private void curves(List<Match> matches, int height) {
        double[] bounds = matches.stream()
                .flatMap(match -> Stream.of(match.a(), match.b()))
                .filter(span -> span instanceof Average one && !one.isEmpty())
                .mapToDouble(span -> ((Average) span).mean())
                .sorted()
                .toArray();
        for (Match match : matches) {
            if (match.verdict() != Verdict.SAME) {
                double from = scale.x(match.either().start());
                add(
                        "<rect class=\"mark\" x=\"%.1f\" y=\"%d\" width=\"%.1f\" height=\"%d\"><title>%s</title></rect>",
                        from, y, Math.max(2, scale.x(match.either().end()) - from), height, escaped(tip(match)));
            }
        }
        if (bounds.length > 0) {
            double least = bounds[0];
            double most = Math.max(bounds[bounds.length - 1], least + 0.1);
            curve("la", matches.stream().map(Match::a).toList(), least, most, height);
            curve("lb", matches.stream().map(Match::b).toList(), least, most, height);
            add(
                    "<text class=\"muted\" x=\"%d\" y=\"%d\" text-anchor=\"end\" font-size=\"10\">%s</text>"
                            + "<text class=\"muted\" x=\"%d\" y=\"%d\" text-anchor=\"end\" font-size=\"10\">%s</text>",
                    LEFT - 6,
                    y + 10,
                    ComparisonText.number(most),
                    LEFT - 6,
                    y + height - 2,
                    ComparisonText.number(least));
        }
    }

    /** A point in the middle of each window; a window without an average is a gap. */
    private void curve(String style, List<Span> spans, double least, double most, int height) {
        StringBuilder path = new StringBuilder();
        boolean gap = true;
        for (Span span : spans.stream()
                .filter(one -> one != null)
                .sorted(Comparator.comparingLong(Span::start))
                .toList()) {
            Average average = (Average) span;
            if (!average.isEmpty()) {
                double at = y + height - 5 - (average.mean() - least) / (most - least) * (height - 10);
                path.append(String.format(
                        Locale.ROOT,
                        "%s%.1f %.1f",
                        gap ? "M" : "L",
                        (scale.x(average.start()) + scale.x(average.end())) / 2,
                        at));
            }
            gap = average.isEmpty();
        }
        add("<path class=\"curve %s\" d=\"%s\"/>", style, path);
    }

    private static String tip(Match match) {
        String what = match.verdict() == Verdict.CHANGED
                ? String.join(
                        ", ",
                        match.changes().stream().map(ComparisonText::change).toList())
                : ComparisonText.value(match.either());
        return "%s, %s, %s: %s"
                .formatted(
                        ComparisonText.time(match.either().start()),
                        ComparisonText.length(match.either()),
                        match.verdict().word(),
                        what);
    }

    /** The end of an id says more than its beginning. */
    private static String shortened(String name) {
        String text = name.replace("urn:ngsi-ld:", "");
        return text.length() <= 42 ? text : "…" + text.substring(text.length() - 41);
    }

    private static String upper(String word) {
        return word.substring(0, 1).toUpperCase(Locale.ROOT) + word.substring(1);
    }

    private static String escaped(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;");
    }

    private void add(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values)).append('\n');
    }
}
