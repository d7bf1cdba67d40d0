package io.furrow.bench.evaluation;

import java.io.IOException;
import java.nio.file.Path;
import java.util.Comparator;
import java.util.List;

import io.furrow.bench.evaluation.Sweep.Point;
import io.furrow.bench.results.JsonLines;

/** Stores results by point in a file. */
public final class EvaluationResults {
    private final JsonLines<PointResult> results;

    /**
     * The common properties of an evaluation's results: those with another heap are not comparable.
     *
     * @param commit of the suite
     * @param heap maximum of its process, MB; 0 if unknown
     * @param seconds duration of the points of a sweep; further ones are shorter
     */
    public record Run(String commit, long heap, long seconds) {}

    private EvaluationResults(JsonLines<PointResult> results) {
        this.results = results;
    }

    /**
     * Reads the file, if it exists.
     *
     * @throws IOException if its content is invalid
     */
    public static EvaluationResults in(Path file) throws IOException {
        return new EvaluationResults(JsonLines.in(file, PointResult.class, "evaluate"));
    }

    void add(PointResult result) throws IOException {
        results.add(result);
    }

    /** The results of one run, by load. */
    List<PointResult> of(Run run, Sweep sweep) {
        return results.all().stream()
                .filter(result -> result.commit().equals(run.commit)
                        && result.heap() == run.heap
                        && result.point().sweep() == sweep
                        && result.lasting() == Evaluation.seconds(result.point(), run.seconds))
                .sorted(Comparator.comparingDouble(result -> result.point().abscissa()))
                .toList();
    }

    /** @return null if it has not been measured */
    PointResult of(Run run, Point point) {
        return of(run, point.sweep()).stream()
                .filter(result -> result.point().equals(point))
                .findFirst()
                .orElse(null);
    }
}
