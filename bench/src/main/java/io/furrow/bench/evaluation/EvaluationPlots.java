package io.furrow.bench.evaluation;

import java.awt.Color;
import java.io.IOException;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.ToDoubleFunction;

import org.knowm.xchart.AnnotationLine;
import org.knowm.xchart.AnnotationText;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.lines.SeriesLines;
import org.knowm.xchart.style.markers.SeriesMarkers;

import io.furrow.bench.frame.Chart;
import io.furrow.bench.load.LoadSecond;

/** Plots results like the figures of the thesis, as PNG. */
final class EvaluationPlots {
    private static final int COLUMNS = 3;
    private static final Color THESIS = new Color(0xb0, 0x3a, 0x2e);
    /** Parts in a plot of processor time. */
    private static final int PARTS = 5;

    private EvaluationPlots() {}

    /** The share of delivered messages, a panel for each sweep. */
    static void delivered(List<List<PointResult>> sweeps, Path file) throws IOException {
        Chart.savePng(sweeps.stream().map(EvaluationPlots::ratios).toList(), 2, file);
    }

    /** Mean and 99th percentile of the delay from device to reader, a panel for each sweep. */
    static void delay(List<List<PointResult>> sweeps, Path file) throws IOException {
        Chart.savePng(sweeps.stream().map(EvaluationPlots::delays).toList(), 2, file);
    }

    /** Processor time of the most expensive parts, a panel for each sweep. */
    static void cores(List<List<PointResult>> sweeps, Path file) throws IOException {
        Map<String, Double> sums = new HashMap<>();
        sweeps.forEach(results -> results.forEach(
                result -> result.cores().forEach((part, cores) -> sums.merge(part, cores, Double::sum))));
        List<String> parts = sums.entrySet().stream()
                .sorted(Map.Entry.<String, Double>comparingByValue().reversed())
                .limit(PARTS)
                .map(Map.Entry::getKey)
                .toList();
        Chart.savePng(sweeps.stream().map(results -> cores(results, parts)).toList(), 2, file);
    }

    /** Messages a second at device, source and reader over time, a panel for each point. */
    static void messages(List<PointResult> results, Path file) throws IOException {
        Chart.savePng(results.stream().map(EvaluationPlots::messages).toList(), COLUMNS, file);
    }

    /** The delay of each hop over time, a panel for each point. */
    static void hops(List<PointResult> results, Path file) throws IOException {
        Chart.savePng(results.stream().map(EvaluationPlots::hops).toList(), COLUMNS, file);
    }

    private static Chart chart(List<PointResult> results, String vertical) {
        Sweep sweep = results.get(0).point().sweep();
        return new Chart(sweep.title(), sweep.abscissa(), vertical);
    }

    private static Chart ratios(List<PointResult> results) {
        Chart chart = chart(results, "delivered / sent").fromZero();
        line(chart, "delivered / sent", results, PointResult::deliveredRatio);
        double max = 1.05;
        chart.xchart().getStyler().setYAxisMax(max);
        chart.xchart().getStyler().setLegendVisible(false);
        double fell = Thesis.fellBeyond(results.get(0).point().sweep());
        chart.xchart().addAnnotation(new AnnotationLine(fell, true, false));
        chart.xchart().addAnnotation(new AnnotationText(" thesis: falls beyond", fell, max / 2, false));
        return chart;
    }

    private static Chart delays(List<PointResult> results) {
        Chart chart = chart(results, "ms, device to reader");
        line(chart, "mean", results, each -> Math.max(1, each.endToEnd().mean()));
        line(chart, "p99", results, each -> Math.max(1, each.endToEnd().p99()));
        Map<Double, Double> theirs =
                new TreeMap<>(Thesis.delays(results.get(0).point().sweep()));
        if (!theirs.isEmpty()) {
            XYSeries series =
                    chart.xchart().addSeries("thesis", List.copyOf(theirs.keySet()), List.copyOf(theirs.values()));
            series.setMarker(SeriesMarkers.DIAMOND);
            series.setMarkerColor(THESIS);
            series.setLineStyle(SeriesLines.NONE);
        }
        chart.xchart().getStyler().setYAxisLogarithmic(true);
        return chart;
    }

    private static Chart cores(List<PointResult> results, List<String> parts) {
        Chart chart = chart(results, "cores").fromZero();
        parts.forEach(
                part -> line(chart, part, results, result -> result.cores().getOrDefault(part, 0.0)));
        chart.xchart().getStyler().setLegendLayout(Styler.LegendLayout.Vertical);
        return chart;
    }

    private static Chart messages(PointResult result) {
        // The first and the last second are incomplete.
        List<LoadSecond> all = result.seconds();
        List<LoadSecond> inside = all.size() < COLUMNS ? all : all.subList(1, all.size() - 1);
        Chart chart = new Chart(result.point().title(), "s", "messages a second").fromZero();
        overTime(chart, "device", inside, LoadSecond::atDevice);
        overTime(chart, "source", inside, LoadSecond::atSource);
        overTime(chart, "reader", inside, LoadSecond::atReader);
        return chart;
    }

    private static Chart hops(PointResult result) {
        List<LoadSecond> inside = result.seconds().stream()
                .filter(second -> second.delays().size() == COLUMNS)
                .toList();
        Chart chart = new Chart(result.point().title(), "s", "ms").fromZero();
        overTime(chart, "to source", inside, second -> second.delays().get(0));
        overTime(chart, "to ingest", inside, second -> second.delays().get(1));
        overTime(chart, "to reader", inside, second -> second.delays().get(2));
        return chart;
    }

    private static void line(
            Chart chart, String name, List<PointResult> results, ToDoubleFunction<PointResult> ordinate) {
        chart.line(name, results, result -> result.point().abscissa(), ordinate);
    }

    private static void overTime(
            Chart chart, String name, List<LoadSecond> seconds, ToDoubleFunction<LoadSecond> ordinate) {
        chart.line(name, seconds, LoadSecond::second, ordinate);
        chart.xchart().getSeriesMap().values().forEach(series -> series.setMarker(SeriesMarkers.NONE));
    }
}
