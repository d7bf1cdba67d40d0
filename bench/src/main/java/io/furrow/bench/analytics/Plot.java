package io.furrow.bench.analytics;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;

/** A plot of lines over two logarithmic axes, as SVG. */
final class Plot {
    private static final int WIDTH = 720;
    private static final int HEIGHT = 420;
    private static final int LEFT = 80;
    private static final int MARGIN = 50;
    private static final int LEGEND = 150;
    private static final String[] COLOURS = {"#1b6ca8", "#d1495b", "#3a7d44", "#8d6a9f", "#c98a1b"};

    private final String title;
    private final String horizontal;
    private final List<Line> lines = new ArrayList<>();

    private record Line(String name, List<double[]> points) {}

    Plot(String title, String horizontal) {
        this.title = title;
        this.horizontal = horizontal;
    }

    /** Points with positive coordinates, in the order of the first. */
    void line(String name, List<double[]> points) {
        if (!points.isEmpty()) {
            lines.add(new Line(name, points));
        }
    }

    String svg() {
        StringBuilder svg = new StringBuilder(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\" font-size=\"12\">%n"
                        .formatted(WIDTH, HEIGHT));
        svg.append("<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>%n".formatted());
        text(svg, LEFT, MARGIN / 2.0, title);
        text(svg, (WIDTH - LEGEND) / 2.0, HEIGHT - 10, horizontal);
        for (double x : powers(point -> point[0])) {
            stroke(svg, x(x), y(least(point -> point[1])), x(x), MARGIN);
            text(svg, x(x) - 15, HEIGHT - MARGIN + 18, brief(x));
        }
        for (double y : powers(point -> point[1])) {
            stroke(svg, LEFT, y(y), WIDTH - LEGEND, y(y));
            text(svg, 10, y(y) + 4, brief(y));
        }
        for (int i = 0; i < lines.size(); i++) {
            draw(svg, lines.get(i), COLOURS[i % COLOURS.length], MARGIN + 20.0 * i);
        }
        return svg.append("</svg>\n").toString();
    }

    private void draw(StringBuilder svg, Line line, String colour, double legend) {
        StringBuilder points = new StringBuilder();
        for (double[] point : line.points) {
            points.append(String.format(Locale.ROOT, "%.1f,%.1f ", x(point[0]), y(point[1])));
            svg.append(String.format(
                    Locale.ROOT,
                    "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>%n",
                    x(point[0]),
                    y(point[1]),
                    colour));
        }
        svg.append(String.format(
                Locale.ROOT,
                "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"/>%n",
                points.toString().trim(),
                colour));
        svg.append(String.format(
                Locale.ROOT,
                "<text x=\"%d\" y=\"%.1f\" fill=\"%s\">%s</text>%n",
                WIDTH - LEGEND + 10,
                legend,
                colour,
                line.name));
    }

    private static void text(StringBuilder svg, double x, double y, String text) {
        svg.append(String.format(Locale.ROOT, "<text x=\"%.1f\" y=\"%.1f\">%s</text>%n", x, y, text));
    }

    private static void stroke(StringBuilder svg, double x1, double y1, double x2, double y2) {
        svg.append(String.format(Locale.ROOT, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#ccc\"/>%n", x1, y1, x2, y2));
    }

    private static String brief(double number) {
        return number >= 1e6
                ? Math.round(number / 1e6) + "M"
                : number >= 1e3 ? Math.round(number / 1e3) + "k" : Long.toString(Math.round(number));
    }

    private double x(double value) {
        return LEFT + share(value, point -> point[0]) * (WIDTH - LEGEND - LEFT);
    }

    private double y(double value) {
        return HEIGHT - MARGIN - share(value, point -> point[1]) * (HEIGHT - 2.0 * MARGIN);
    }

    private double share(double value, ToDoubleFunction<double[]> axis) {
        double low = Math.log(least(axis));
        double high = Math.log(greatest(axis));
        return high > low ? (Math.log(value) - low) / (high - low) : 0.5;
    }

    /** The power of ten at or below the least coordinate. */
    private double least(ToDoubleFunction<double[]> axis) {
        double least = lines.stream()
                .flatMap(line -> line.points.stream())
                .mapToDouble(axis)
                .min()
                .orElse(1);
        return Math.pow(10, Math.floor(Math.log10(least)));
    }

    private double greatest(ToDoubleFunction<double[]> axis) {
        double greatest = lines.stream()
                .flatMap(line -> line.points.stream())
                .mapToDouble(axis)
                .max()
                .orElse(1);
        return Math.pow(10, Math.ceil(Math.log10(greatest)));
    }

    private List<Double> powers(ToDoubleFunction<double[]> axis) {
        List<Double> powers = new ArrayList<>();
        for (double power = least(axis); power <= greatest(axis) * 1.01; power *= 10) {
            powers.add(power);
        }
        return powers;
    }
}
