package io.furrow.bench.evaluation;

import java.awt.Color;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.ToDoubleFunction;
import java.util.stream.IntStream;

import org.knowm.xchart.AnnotationLine;
import org.knowm.xchart.AnnotationText;
import org.knowm.xchart.BitmapEncoder;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.XYStyler;
import org.knowm.xchart.style.lines.SeriesLines;
import org.knowm.xchart.style.markers.SeriesMarkers;

import io.furrow.bench.load.LoadSecond;

/** Plots of results in the form of the thesis' figures, as PNG. */
final class EvaluationPlots {
    private static final int COLUMNS = 3;
    private static final int WIDTH = 420;
    private static final int HEIGHT = 300;
    private static final Color[] COLORS = {
        new Color(0x1b, 0x6c, 0xa8),
        new Color(0xc9, 0x8a, 0x1b),
        new Color(0x3a, 0x7d, 0x44),
        new Color(0x8e, 0x44, 0x8e),
        new Color(0x5f, 0x6b, 0x76)
    };
    private static final Color THESIS = new Color(0xb0, 0x3a, 0x2e);
    /** Parts of a plot of processor time. */
    private static final int PARTS = 5;

    private EvaluationPlots() {}

    /** The share of messages that arrived, a panel for each sweep. */
    static void delivered(List<List<PointResult>> sweeps, Path file) throws IOException {
        save(
                sweeps.stream()
                        .map(results -> line(results, "delivered / sent", PointResult::deliveredRatio, 1.05))
                        .toList(),
                2,
                file);
    }

    /** Mean and 99th percentile of the delay from device to reader, a panel for each sweep. */
    static void delay(List<List<PointResult>> sweeps, Path file) throws IOException {
        save(sweeps.stream().map(EvaluationPlots::delays).toList(), 2, file);
    }

    /** Processor time of those parts that take most of it, a panel for each sweep. */
    static void cores(List<List<PointResult>> sweeps, Path file) throws IOException {
        Map<String, Double> sums = new HashMap<>();
        sweeps.forEach(results -> results.forEach(
                result -> result.cores().forEach((part, cores) -> sums.merge(part, cores, Double::sum))));
        List<String> parts = sums.entrySet().stream()
                .sorted(Map.Entry.<String, Double>comparingByValue().reversed())
                .limit(PARTS)
                .map(Map.Entry::getKey)
                .toList();
        save(sweeps.stream().map(results -> cores(results, parts)).toList(), 2, file);
    }

    /** Messages a second at device, source and reader over time, a panel for each point. */
    static void messages(List<PointResult> results, Path file) throws IOException {
        save(results.stream().map(EvaluationPlots::messages).toList(), COLUMNS, file);
    }

    /** The delay of each hop over time, a panel for each point. */
    static void hops(List<PointResult> results, Path file) throws IOException {
        save(results.stream().map(EvaluationPlots::hops).toList(), COLUMNS, file);
    }

    private static XYChart line(
            List<PointResult> results, String title, ToDoubleFunction<PointResult> ordinate, double max) {
        XYChart chart = chart(
                results.get(0).point().sweep().title(),
                results.get(0).point().sweep().abscissa(),
                title);
        add(
                chart,
                title,
                abscissas(results),
                results.stream().mapToDouble(ordinate).toArray(),
                0);
        chart.getStyler().setYAxisMin(0.0);
        chart.getStyler().setYAxisMax(max);
        chart.getStyler().setLegendVisible(false);
        double fell = Thesis.fellBeyond(results.get(0).point().sweep());
        chart.addAnnotation(new AnnotationLine(fell, true, false));
        chart.addAnnotation(new AnnotationText(" thesis: falls beyond", fell, max / 2, false));
        return chart;
    }

    private static XYChart delays(List<PointResult> results) {
        XYChart chart = chart(
                results.get(0).point().sweep().title(),
                results.get(0).point().sweep().abscissa(),
                "ms, device to reader");
        add(
                chart,
                "mean",
                abscissas(results),
                results.stream()
                        .mapToDouble(each -> Math.max(1, each.endToEnd().mean()))
                        .toArray(),
                0);
        add(
                chart,
                "p99",
                abscissas(results),
                results.stream()
                        .mapToDouble(each -> Math.max(1, each.endToEnd().p99()))
                        .toArray(),
                1);
        Map<Double, Double> theirs =
                new TreeMap<>(Thesis.delays(results.get(0).point().sweep()));
        if (!theirs.isEmpty()) {
            XYSeries series = chart.addSeries("thesis", List.copyOf(theirs.keySet()), List.copyOf(theirs.values()));
            series.setMarker(SeriesMarkers.DIAMOND);
            series.setMarkerColor(THESIS);
            series.setLineStyle(SeriesLines.NONE);
        }
        chart.getStyler().setYAxisLogarithmic(true);
        return chart;
    }

    private static XYChart cores(List<PointResult> results, List<String> parts) {
        Sweep sweep = results.get(0).point().sweep();
        XYChart chart = chart(sweep.title(), sweep.abscissa(), "cores");
        for (int part = 0; part < parts.size(); part++) {
            String name = parts.get(part);
            double[] cores = results.stream()
                    .mapToDouble(result -> result.cores().getOrDefault(name, 0.0))
                    .toArray();
            add(chart, name, abscissas(results), cores, part);
        }
        chart.getStyler().setYAxisMin(0.0);
        chart.getStyler().setLegendLayout(Styler.LegendLayout.Vertical);
        return chart;
    }

    private static XYChart messages(PointResult result) {
        XYChart chart = chart(result.point().title(), "s", "messages a second");
        List<LoadSecond> inside = inside(result);
        add(chart, "device", inside, LoadSecond::atDevice, 0);
        add(chart, "source", inside, LoadSecond::atSource, 1);
        add(chart, "reader", inside, LoadSecond::atReader, 2);
        chart.getStyler().setYAxisMin(0.0);
        return chart;
    }

    private static XYChart hops(PointResult result) {
        XYChart chart = chart(result.point().title(), "s", "ms");
        List<LoadSecond> inside = result.seconds().stream()
                .filter(second -> second.delays().size() == COLUMNS)
                .toList();
        String[] names = {"to source", "to ingest", "to reader"};
        IntStream.range(0, names.length)
                .forEach(hop ->
                        add(chart, names[hop], inside, second -> second.delays().get(hop), hop));
        chart.getStyler().setYAxisMin(0.0);
        return chart;
    }

    /** The first and the last second are only parts of one. */
    private static List<LoadSecond> inside(PointResult result) {
        List<LoadSecond> all = result.seconds();
        return all.size() < COLUMNS ? all : all.subList(1, all.size() - 1);
    }

    private static void add(
            XYChart chart, String name, List<LoadSecond> seconds, ToDoubleFunction<LoadSecond> ordinate, int color) {
        double[] times = seconds.stream().mapToDouble(LoadSecond::second).toArray();
        if (times.length > 0) {
            add(chart, name, times, seconds.stream().mapToDouble(ordinate).toArray(), color);
            chart.getSeriesMap().get(name).setMarker(SeriesMarkers.NONE);
        }
    }

    private static void add(XYChart chart, String name, double[] abscissas, double[] ordinates, int color) {
        XYSeries series = chart.addSeries(name, abscissas, ordinates);
        series.setMarker(SeriesMarkers.CIRCLE);
        series.setMarkerColor(COLORS[color]);
        series.setLineColor(COLORS[color]);
    }

    private static double[] abscissas(List<PointResult> results) {
        return results.stream().mapToDouble(result -> result.point().abscissa()).toArray();
    }

    private static XYChart chart(String title, String horizontal, String vertical) {
        XYChart chart = new XYChartBuilder()
                .width(WIDTH)
                .height(HEIGHT)
                .title(title)
                .xAxisTitle(horizontal)
                .yAxisTitle(vertical)
                .build();
        XYStyler style = chart.getStyler();
        style.setPlotGridLinesColor(new Color(0xe4, 0xe4, 0xe4));
        style.setPlotBorderVisible(false);
        style.setMarkerSize(6);
        style.setChartBackgroundColor(Color.WHITE);
        style.setLegendBorderColor(Color.WHITE);
        style.setLegendPosition(Styler.LegendPosition.OutsideS);
        style.setLegendLayout(Styler.LegendLayout.Horizontal);
        return chart;
    }

    private static void save(List<XYChart> charts, int columns, Path file) throws IOException {
        int rows = (charts.size() + columns - 1) / columns;
        BufferedImage image = new BufferedImage(WIDTH * columns, HEIGHT * rows, BufferedImage.TYPE_INT_RGB);
        var graphics = image.createGraphics();
        graphics.setColor(Color.WHITE);
        graphics.fillRect(0, 0, image.getWidth(), image.getHeight());
        for (int i = 0; i < charts.size(); i++) {
            graphics.drawImage(
                    BitmapEncoder.getBufferedImage(charts.get(i)), i % columns * WIDTH, i / columns * HEIGHT, null);
        }
        graphics.dispose();
        javax.imageio.ImageIO.write(image, "png", file.toFile());
    }
}
