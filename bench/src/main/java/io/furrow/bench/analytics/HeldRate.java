package io.furrow.bench.analytics;

import java.util.ArrayList;
import java.util.List;

/**
 * A fleet that reported once a second, and the job behind it.
 *
 * @param sentPerSecond what the fleet really sent
 * @param lags of the job's consumer at the end of each second, in records, as of its newest checkpoint
 */
public record HeldRate(int devices, double sentPerSecond, List<Long> lags) {
    /** Of the rate: what the slope of a lag that only swings with the checkpoints stays below. */
    private static final double GROWTH = 0.01;

    /** Records per second by which the lag grows, by least squares. */
    public double slope() {
        double meanSecond = (lags.size() - 1) / 2.0;
        double meanLag = lags.stream().mapToLong(Long::longValue).average().orElse(0);
        double above = 0;
        double below = 0;
        for (int second = 0; second < lags.size(); second++) {
            above += (second - meanSecond) * (lags.get(second) - meanLag);
            below += (second - meanSecond) * (second - meanSecond);
        }
        return below == 0 ? 0 : above / below;
    }

    /** Whether all devices reported and the lag did not grow. */
    public boolean isHeld() {
        return sentPerSecond >= (1 - GROWTH) * devices && slope() <= GROWTH * devices;
    }

    public void addTo(Figures figures) {
        figures.add(
                "devices", devices,
                "sent/s", sentPerSecond,
                "seconds", lags.size(),
                "first lag", lags.get(0),
                "last lag", lags.get(lags.size() - 1),
                "slope/s", slope(),
                "held", isHeld());
    }

    /** Lag over seconds. */
    public String svg() {
        List<double[]> points = new ArrayList<>();
        for (int second = 0; second < lags.size(); second++) {
            points.add(new double[] {second + 1, Math.max(1, lags.get(second))});
        }
        Plot plot = new Plot("Lag of the consumer in records, %,d devices at 1 Hz".formatted(devices), "seconds");
        plot.line("lag", points);
        plot.line("a second's", List.of(new double[] {1, devices}, new double[] {lags.size(), devices}));
        return plot.svg();
    }
}
