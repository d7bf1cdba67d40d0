package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.List;

/**
 * The coverage of a field beside its cells.
 *
 * @param begin of the first swath, epoch ms
 * @param last the newest swath, without its area
 * @param cell side of a cell as requested, meters
 * @param width the greatest working width, meters
 * @param covered number of cells that are covered
 * @param overlapped number of cells that are covered again
 * @param recent the swaths that their robots may continue
 * @param reportAt when the next report is due, epoch ms; {@link #NEVER} if nothing has changed since the last
 * @param samples earlier numbers of covered cells, the oldest first
 */
public record CoverageState(
        long begin,
        Swath last,
        double cell,
        double width,
        long covered,
        long overlapped,
        List<Swath> recent,
        long reportAt,
        List<Sample> samples) {
    static final long NEVER = Long.MAX_VALUE;

    /**
     * How much was covered at an instant.
     *
     * @param time epoch ms
     * @param covered number of cells
     */
    public record Sample(long time, long covered) {}

    static CoverageState begun(Swath first, double cell) {
        long begin = first.from().time();
        return new CoverageState(
                begin, first.withoutArea(), cell, 0, 0, 0, List.of(), NEVER, List.of(new Sample(begin, 0)));
    }

    boolean isReportDue(long until) {
        return reportAt != NEVER && reportAt <= until;
    }

    CoverageState with(Swath swath, long newlyCovered, long newlyOverlapped, List<Swath> nowRecent, long nextReport) {
        return new CoverageState(
                begin,
                swath.withoutArea(),
                cell,
                Math.max(width, swath.width()),
                covered + newlyCovered,
                overlapped + newlyOverlapped,
                nowRecent,
                nextReport,
                samples);
    }

    /** After a report; retains one sample from before the window that ends now. */
    CoverageState reported(long time, long window, List<Swath> nowRecent) {
        List<Sample> now = new ArrayList<>(samples);
        now.add(new Sample(time, covered));
        while (now.size() > 1 && now.get(1).time() <= time - window) {
            now.remove(0);
        }
        return new CoverageState(begin, last, cell, width, covered, overlapped, nowRecent, NEVER, now);
    }

    /** The same where the rate is measured from an instant on. */
    CoverageState resumedAt(long time) {
        List<Sample> now = List.of(new Sample(time, covered));
        return new CoverageState(begin, last, cell, width, covered, overlapped, recent, reportAt, now);
    }
}
