package io.furrow.bench.evaluation;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import com.fasterxml.jackson.databind.ObjectMapper;

import io.furrow.bench.evaluation.Sweep.Point;

/** Results by point, in a file of JSON lines that grows: an evaluation that was interrupted goes on where it was. */
public final class EvaluationResults {
    private static final ObjectMapper JSON = new ObjectMapper();

    private final Path file;
    private final List<PointResult> results = new ArrayList<>();

    private EvaluationResults(Path file) {
        this.file = file;
    }

    /**
     * Begins with what the file holds; it need not exist.
     *
     * @throws IOException if it holds something else
     */
    public static EvaluationResults in(Path file) throws IOException {
        EvaluationResults all = new EvaluationResults(file);
        if (Files.exists(file)) {
            for (String line : Files.readAllLines(file)) {
                try {
                    all.results.add(JSON.readValue(line, PointResult.class));
                } catch (IOException e) {
                    throw new IOException(file + " is no file of results; name another with --results", e);
                }
            }
        }
        return all;
    }

    void add(PointResult result) throws IOException {
        Files.writeString(
                file,
                JSON.writeValueAsString(result) + "\n",
                StandardCharsets.UTF_8,
                StandardOpenOption.CREATE,
                StandardOpenOption.APPEND);
        results.add(result);
    }

    /** Those of one commit, by load; {@code seconds} of the points of the sweep, further ones are measured for less. */
    List<PointResult> of(String commit, long seconds, Sweep sweep) {
        return results.stream()
                .filter(result -> result.commit().equals(commit)
                        && result.point().sweep() == sweep
                        && result.lasting() == Evaluation.seconds(result.point(), seconds))
                .sorted(Comparator.comparingDouble(result -> result.point().abscissa()))
                .toList();
    }

    /** @return null if it is not measured */
    PointResult of(String commit, long seconds, Point point) {
        return of(commit, seconds, point.sweep()).stream()
                .filter(result -> result.point().equals(point))
                .findFirst()
                .orElse(null);
    }
}
