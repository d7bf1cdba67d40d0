package io.furrow.bench.whole;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.DoubleStream;

import io.furrow.bench.frame.Figures;
import io.furrow.bench.whole.Part.Figure;

/** Stores figures by turn in a growing file, so that an interrupted measurement can continue. */
final class WholeResults {
    private record Row(int turn, Part part, String checkout, Figure figure, double value) {
        static Row parse(String line) {
            String[] cells = line.split(",");
            return new Row(
                    Integer.parseInt(cells[0]),
                    Part.valueOf(cells[1]),
                    cells[2],
                    Figure.valueOf(cells[3]),
                    Double.parseDouble(cells[4]));
        }

        String line() {
            return String.format(Locale.ROOT, "%d,%s,%s,%s,%.4f", turn, part, checkout, figure, value);
        }
    }

    private final Path file;
    private final List<Row> rows = new ArrayList<>();

    private WholeResults(Path file) {
        this.file = file;
    }

    /** Reads the file, if it exists. */
    static WholeResults in(Path file) throws IOException {
        WholeResults results = new WholeResults(file);
        if (Files.exists(file)) {
            Files.readAllLines(file).stream().map(Row::parse).forEach(results.rows::add);
        }
        return results;
    }

    boolean has(int turn, Part part, Checkout checkout) {
        return rows.stream()
                .anyMatch(row -> row.turn() == turn
                        && row.part() == part
                        && row.checkout().equals(checkout.name()));
    }

    void add(int turn, Part part, Checkout checkout, Map<Figure, Double> figures) throws IOException {
        List<Row> added = figures.entrySet().stream()
                .map(figure -> new Row(turn, part, checkout.name(), figure.getKey(), figure.getValue()))
                .toList();
        Files.write(file, added.stream().map(Row::line).toList(), StandardOpenOption.CREATE, StandardOpenOption.APPEND);
        rows.addAll(added);
    }

    /** A line per part and figure: the medians of both, and of the ratios of the turns. */
    Figures figures(Checkout here, Checkout other) {
        Figures figures = new Figures("medians of " + here.name() + " and " + other.name());
        for (Part part : Part.values()) {
            for (Figure figure : part.figures()) {
                List<Row> own = of(part, figure, here);
                List<Row> others = of(part, figure, other);
                if (!own.isEmpty() && !others.isEmpty()) {
                    DoubleStream ratios = own.stream()
                            .flatMap(row -> others.stream()
                                    .filter(its -> its.turn() == row.turn())
                                    .map(its -> row.value() / its.value()))
                            .mapToDouble(Double::doubleValue);
                    figures.add(
                            "part",
                            part.title(),
                            "median",
                            figure.title(),
                            here.name(),
                            Figures.median(own, Row::value),
                            other.name() + " ",
                            Figures.median(others, Row::value),
                            "ratio",
                            Figures.median(ratios));
                }
            }
        }
        return figures;
    }

    private List<Row> of(Part part, Figure figure, Checkout checkout) {
        return rows.stream()
                .filter(row -> row.part() == part
                        && row.figure() == figure
                        && row.checkout().equals(checkout.name()))
                .toList();
    }
}
