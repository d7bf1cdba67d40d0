package io.furrow.bench.whole;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;

import io.furrow.bench.whole.Part.Figure;

/** Figures by turn, in a file that grows line by line: a measurement that was interrupted goes on where it was. */
public final class WholeResults {
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

    /** Begins with what the file holds; it need not exist. */
    public static WholeResults in(Path file) throws IOException {
        WholeResults results = new WholeResults(file);
        if (Files.exists(file)) {
            Files.readAllLines(file).stream().map(Row::parse).forEach(results.rows::add);
        }
        return results;
    }

    public boolean has(int turn, Part part, Checkout checkout) {
        return rows.stream()
                .anyMatch(row -> row.turn() == turn
                        && row.part() == part
                        && row.checkout().equals(checkout.name()));
    }

    public void add(int turn, Part part, Checkout checkout, Map<Figure, Double> figures) throws IOException {
        List<Row> added = figures.entrySet().stream()
                .map(figure -> new Row(turn, part, checkout.name(), figure.getKey(), figure.getValue()))
                .toList();
        Files.write(file, added.stream().map(Row::line).toList(), StandardOpenOption.CREATE, StandardOpenOption.APPEND);
        rows.addAll(added);
    }

    /** A line per part and figure: the medians of both, and of the ratios of the turns. */
    public void print(PrintWriter out, Checkout here, Checkout other) {
        out.printf("%-10s %-20s %12s %12s %8s%n", "", "median", here.name(), other.name(), "ratio");
        for (Part part : Part.values()) {
            for (Figure figure : part.figures()) {
                List<Row> own = of(part, figure, here);
                List<Row> others = of(part, figure, other);
                if (own.isEmpty() || others.isEmpty()) {
                    continue;
                }
                List<Double> ratios = own.stream()
                        .flatMap(row -> others.stream()
                                .filter(its -> its.turn() == row.turn())
                                .map(its -> row.value() / its.value()))
                        .toList();
                out.printf(
                        Locale.ROOT,
                        "%-10s %-20s %12.2f %12.2f %8.2f%n",
                        part.title(),
                        figure.title(),
                        median(values(own)),
                        median(values(others)),
                        median(ratios));
            }
        }
        out.flush();
    }

    private List<Row> of(Part part, Figure figure, Checkout checkout) {
        return rows.stream()
                .filter(row -> row.part() == part
                        && row.figure() == figure
                        && row.checkout().equals(checkout.name()))
                .toList();
    }

    private static List<Double> values(List<Row> rows) {
        return rows.stream().map(Row::value).toList();
    }

    private static double median(List<Double> values) {
        List<Double> sorted = values.stream().sorted().toList();
        return sorted.isEmpty() ? Double.NaN : sorted.get(sorted.size() / 2);
    }
}
