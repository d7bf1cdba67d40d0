package io.furrow.bench.frame;

import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.function.ToDoubleFunction;
import javax.imageio.ImageIO;

import org.knowm.xchart.BitmapEncoder;
import org.knowm.xchart.VectorGraphicsEncoder;
import org.knowm.xchart.XYChart;
import org.knowm.xchart.XYChartBuilder;
import org.knowm.xchart.XYSeries;
import org.knowm.xchart.style.Styler;
import org.knowm.xchart.style.XYStyler;
import org.knowm.xchart.style.markers.SeriesMarkers;

/** A chart of lines. */
public final class Chart {
    private static final Color[] COLORS = {
        new Color(0x1b, 0x6c, 0xa8),
        new Color(0xc9, 0x8a, 0x1b),
        new Color(0x3a, 0x7d, 0x44),
        new Color(0x8e, 0x44, 0x8e),
        new Color(0x5f, 0x6b, 0x76)
    };
    private static final int WIDTH = 420;
    private static final int HEIGHT = 300;

    private final XYChart chart;

    public Chart(String title, String horizontal, String vertical) {
        chart = new XYChartBuilder()
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
    }

    /** The underlying chart, for further settings. */
    public XYChart xchart() {
        return chart;
    }

    /** Makes both axes logarithmic; all values must be positive. */
    public Chart logarithmic() {
        chart.getStyler().setXAxisLogarithmic(true);
        chart.getStyler().setYAxisLogarithmic(true);
        return this;
    }

    /** Draws from zero on. */
    public Chart fromZero() {
        chart.getStyler().setYAxisMin(0.0);
        return this;
    }

    /** Draws a line in the next color, if there are points. */
    public <T> Chart line(String name, List<T> points, ToDoubleFunction<T> x, ToDoubleFunction<T> y) {
        if (!points.isEmpty()) {
            Color color = COLORS[chart.getSeriesMap().size() % COLORS.length];
            XYSeries series = chart.addSeries(
                    name,
                    points.stream().mapToDouble(x).toArray(),
                    points.stream().mapToDouble(y).toArray());
            series.setMarker(SeriesMarkers.CIRCLE);
            series.setMarkerColor(color);
            series.setLineColor(color);
        }
        return this;
    }

    public void saveSvg(Path file) throws IOException {
        VectorGraphicsEncoder.saveVectorGraphic(chart, file.toString(), VectorGraphicsEncoder.VectorGraphicsFormat.SVG);
    }

    /** Saves a picture of several charts in rows. */
    public static void savePng(List<Chart> charts, int columns, Path file) throws IOException {
        int rows = (charts.size() + columns - 1) / columns;
        BufferedImage image = new BufferedImage(WIDTH * columns, HEIGHT * rows, BufferedImage.TYPE_INT_RGB);
        Graphics2D graphics = image.createGraphics();
        graphics.setColor(Color.WHITE);
        graphics.fillRect(0, 0, image.getWidth(), image.getHeight());
        for (int i = 0; i < charts.size(); i++) {
            BufferedImage one = BitmapEncoder.getBufferedImage(charts.get(i).chart);
            graphics.drawImage(one, i % columns * WIDTH, i / columns * HEIGHT, null);
        }
        graphics.dispose();
        ImageIO.write(image, "png", file.toFile());
    }
}
