package io.furrow.bench.component;

import java.util.List;
import java.util.function.ToDoubleFunction;

import io.furrow.bench.component.Component.Rates;

/**
 * Compares a component with an older commit, each as a share of its peer measured in the same minutes: machines and hours differ more
 * than commits.
 */
final class Comparison {
    /** With fewer turns a difference is not significant. */
    private static final int MIN_TURNS = 3;
    /** Smaller differences of the medians are noise, however well the turns agree. */
    private static final double MIN_CHANGE = 0.05;

    private final List<Rates> before;
    private final List<Rates> now;

    Comparison(List<Rates> before, List<Rates> now) {
        this.before = before;
        this.now = now;
    }

    /** A figure's median. @return NaN without turns */
    static double median(List<Rates> turns, ToDoubleFunction<Rates> figure) {
        double[] sorted = turns.stream().mapToDouble(figure).sorted().toArray();
        int middle = sorted.length / 2;
        return sorted.length == 0
                ? Double.NaN
                : sorted.length % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
    }

    /** The share now divided by the share before. */
    double ratio() {
        return median(now, Rates::share) / median(before, Rates::share);
    }

    /** The verdict with its reason. */
    String verdict() {
        if (Math.min(before.size(), now.size()) < MIN_TURNS) {
            return "too few turns (%d and %d, %d are needed)".formatted(before.size(), now.size(), MIN_TURNS);
        }
        if (Math.abs(ratio() - 1) < MIN_CHANGE) {
            return "the same";
        }
        boolean apart = min(now) > max(before) || max(now) < min(before);
        if (!apart) {
            return "noise: turns overlap";
        }
        return ratio() > 1 ? "faster" : "slower";
    }

    private static double min(List<Rates> turns) {
        return turns.stream().mapToDouble(Rates::share).min().orElseThrow();
    }

    private static double max(List<Rates> turns) {
        return turns.stream().mapToDouble(Rates::share).max().orElseThrow();
    }
}
