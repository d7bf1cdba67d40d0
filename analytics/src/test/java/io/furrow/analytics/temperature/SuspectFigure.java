package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Collectors;

/** Draws what {@link SuspectSimulation} finds: {@code docs/suspects.svg}, for light and dark pages. */
final class SuspectFigure {
    static final List<Double> SIGMAS = List.of(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0);

    /**
     * A diagram.
     *
     * @param bound share that the promise names
     * @param ticks of both axes
     */
    private record Panel(String title, String axis, List<Double> x, List<Double> y, double bound, List<Line> lines) {}

    private record Line(String name, Map<? extends Number, Double> shares) {}

    private static final int WIDTH = 250;
    private static final int HEIGHT = 190;
    private static final int APART = 318;
    private static final String[] CLASSES = {"a", "b", "c", "d"};

    private static final String HEAD = """
            <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 344" role="img" font-family="system-ui, sans-serif" font-size="12">
            <title>How often the job temperature names sound and defective devices, simulated</title>
            <style>
            .page { fill: #ffffff } .text { fill: #17211b } .muted { fill: #56665b } .grid { stroke: #d9e0d6 }
            .bound { stroke: #b3261e } .a { stroke: #1f7a3a } .b { stroke: #0b5cad } .c { stroke: #9a5b00 } .d { stroke: #17211b }
            .line { fill: none; stroke-width: 2; stroke-linejoin: round } .b { stroke-dasharray: 7 3 } .c { stroke-dasharray: 2 3 }
            .d { stroke-dasharray: 9 3 2 3 }
            @media (prefers-color-scheme: dark) {
              .page { fill: #151d19 } .text { fill: #e8f0ea } .muted { fill: #9fb2a6 } .grid { stroke: #2b3831 }
              .bound { stroke: #ff7a6b } .a { stroke: #7bd88f } .b { stroke: #6db7ff } .c { stroke: #ffb638 } .d { stroke: #e8f0ea }
            }
            </style>
            <rect class="page" width="960" height="344" rx="8"/>
            """;

    private SuspectFigure() {}

    static String of(SuspectSimulation simulation) {
        List<Double> devices = List.of(3.0, 5.0, 10.0, 15.0, 20.0);
        List<Line> sound = new ArrayList<>();
        List<Line> defective = new ArrayList<>();
        for (double step : List.of(0.0, 0.1, 0.5)) {
            String name = step == 0 ? "exact votes" : "rounded to " + step + " °C";
            sound.add(new Line(name, simulation.soundNamed(step)));
            defective.add(new Line(name, simulation.namedWithin(3, 5, step)));
        }
        List<Line> wide = new ArrayList<>();
        for (int count : List.of(4, 5, 10, 20)) {
            Map<Double, Double> shares = new TreeMap<>();
            SIGMAS.forEach(sigma -> shares.put(sigma, simulation.soundNamed(count, sigma, 0)));
            wide.add(new Line(count + " devices", shares));
        }
        StringBuilder svg = new StringBuilder(HEAD);
        List<Panel> panels = List.of(
                new Panel(
                        "Windows that name a sound device",
                        "devices; σ = 0.3 °C",
                        devices,
                        List.of(0.0, 0.002, 0.004, 0.006, 0.008, 0.01),
                        0.01,
                        sound),
                new Panel(
                        "A device 5 σ off, named within three windows",
                        "devices; σ = 0.3 °C",
                        devices,
                        List.of(0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0),
                        0.95,
                        defective),
                new Panel(
                        "Windows that name a sound device",
                        "σ of sound devices, °C; exact votes",
                        List.of(0.0, 0.5, 1.0, 1.5, 2.0),
                        List.of(0.0, 0.1, 0.2, 0.3, 0.4, 0.5),
                        0.01,
                        wide));
        for (int i = 0; i < panels.size(); i++) {
            svg.append("<g transform=\"translate(%d 48)\">%n%s</g>%n".formatted(50 + APART * i, drawn(panels.get(i))));
        }
        return svg.append("</svg>\n").toString().replace("\r\n", "\n");
    }

    private static String drawn(Panel panel) {
        StringBuilder svg = new StringBuilder();
        text(svg, "text", -36, -22, "start", panel.title());
        for (double y : panel.y()) {
            line(svg, "grid", 0, WIDTH, at(y, panel.y(), HEIGHT, true), at(y, panel.y(), HEIGHT, true));
            String percent = String.format(Locale.ROOT, y < 0.01 && y > 0 ? "%.1f %%" : "%.0f %%", 100 * y);
            text(svg, "muted", -6, at(y, panel.y(), HEIGHT, true) + 4, "end", percent);
        }
        for (double x : panel.x()) {
            String number = x == Math.rint(x) ? String.valueOf((int) x) : String.valueOf(x);
            text(svg, "muted", at(x, panel.x(), WIDTH, false), HEIGHT + 16, "middle", number);
        }
        text(svg, "muted", WIDTH, HEIGHT + 34, "end", panel.axis());
        double bound = at(panel.bound(), panel.y(), HEIGHT, true);
        line(svg, "bound", 0, WIDTH, bound, bound);
        for (int i = 0; i < panel.lines().size(); i++) {
            Line line = panel.lines().get(i);
            String points = line.shares().entrySet().stream()
                    .map(point -> number(at(point.getKey().doubleValue(), panel.x(), WIDTH, false)) + ","
                            + number(at(point.getValue(), panel.y(), HEIGHT, true)))
                    .collect(Collectors.joining(" "));
            svg.append("<polyline class=\"line %s\" points=\"%s\"/>%n".formatted(CLASSES[i], points));
            int left = -36 + 128 * (i % 2);
            int top = HEIGHT + 54 + 18 * (i / 2);
            line(svg, "line " + CLASSES[i], left, left + 26, top, top);
            text(svg, "text", left + 32, top + 4, "start", line.name());
        }
        return svg.toString();
    }

    /** Where a value is between the first tick and the last. */
    private static double at(double value, List<Double> ticks, int length, boolean upward) {
        double first = ticks.get(0);
        double share = (value - first) / (ticks.get(ticks.size() - 1) - first);
        return length * (upward ? 1 - share : share);
    }

    private static void line(StringBuilder svg, String style, double x1, double x2, double y1, double y2) {
        svg.append("<line class=\"%s\" x1=\"%s\" x2=\"%s\" y1=\"%s\" y2=\"%s\"/>%n"
                .formatted(style, number(x1), number(x2), number(y1), number(y2)));
    }

    private static void text(StringBuilder svg, String style, double x, double y, String anchor, String text) {
        svg.append("<text class=\"%s\" x=\"%s\" y=\"%s\" text-anchor=\"%s\">%s</text>%n"
                .formatted(style, number(x), number(y), anchor, text));
    }

    private static String number(double value) {
        return String.format(Locale.ROOT, "%.1f", value);
    }
}
