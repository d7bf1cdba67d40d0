package io.furrow.analytics.coverage;

import java.util.List;
import java.util.Optional;

/**
 * The way of a robot.
 *
 * @param time of its newest report, epoch ms
 * @param last its newest report with a position, with all that was known then; null if there is none
 * @param width the newest working width, meters; NaN if none was reported
 * @param work the newest state of the implement
 * @param priorLatitude where the swath up to {@code last} began, degrees; NaN if there is none
 * @param priorLongitude likewise
 * @param driven meters along continued swaths up to {@code last}
 * @param opened the coverages to which it has contributed
 */
public record Drive(
        long time,
        WorkReport last,
        double width,
        WorkReport.Work work,
        double priorLatitude,
        double priorLongitude,
        double driven,
        List<Opened> opened) {
    /**
     * A coverage of a robot.
     *
     * @param key of its swaths
     * @param time of the newest one, epoch ms
     */
    public record Opened(String key, long time) {}

    static final Drive NONE =
            new Drive(Long.MIN_VALUE, null, Double.NaN, WorkReport.Work.UNKNOWN, Double.NaN, Double.NaN, 0, List.of());

    /** A report with what was known before. */
    WorkReport completed(WorkReport report) {
        return new WorkReport(
                report.fix(),
                Double.isNaN(report.width()) ? width : report.width(),
                report.work() == WorkReport.Work.UNKNOWN ? work : report.work());
    }

    Drive knowing(WorkReport report) {
        return new Drive(
                report.time(), last, report.width(), report.work(), priorLatitude, priorLongitude, driven, opened);
    }

    /** At a position that no swath leads to. */
    Drive at(WorkReport report) {
        return new Drive(report.time(), report, report.width(), report.work(), Double.NaN, Double.NaN, 0, opened);
    }

    /** At a position that a swath leads to. */
    Drive after(WorkReport report, List<Opened> nowOpened) {
        double length = Swath.distance(last.fix(), report.fix());
        return new Drive(
                report.time(),
                report,
                report.width(),
                report.work(),
                last.fix().latitude(),
                last.fix().longitude(),
                driven + length,
                nowOpened);
    }

    Optional<Opened> opened(String key) {
        return opened.stream().filter(each -> each.key().equals(key)).findAny();
    }
}
