package io.furrow.analytics.coverage;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.TreeMap;
import java.util.function.Consumer;

import org.locationtech.jts.io.WKBWriter;

import io.furrow.analytics.coverage.Drive.Opened;
import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.Field;
import io.furrow.analytics.field.FieldVersions;

/** Builds the swaths of one robot: between two positions while it works, for each field that has one of the two. */
final class SwathBuilder implements Serializable {
    /** Maximum number of coverages of a robot within their time-to-live: a robot names its mission. */
    static final int MAX_OPENED = 32;

    private static final long serialVersionUID = 1L;
    private static final double MILLIS = 1000;

    private final CoverageRules rules;

    SwathBuilder(CoverageRules rules) {
        this.rules = rules;
    }

    /** Receives what follows from a report. */
    interface Output extends Consumer<Swath> {
        /** A swath beyond {@link #MAX_OPENED} coverages. */
        void reject();
    }

    /**
     * @param report later than those before
     * @return what is known of the robot afterwards
     */
    Drive advance(Drive before, WorkReport report, FieldVersions fields, Output out) {
        WorkReport now = before.completed(report);
        if (!now.isLocated()) {
            return before.knowing(now);
        }
        if (before.last() == null || !works(before.last(), now)) {
            return before.at(now);
        }
        List<Opened> opened = new ArrayList<>(before.opened());
        opened.removeIf(each -> each.time() + rules.timeToLive().toMillis() <= now.time());
        boolean covers = false;
        for (Field field : fields(before.last(), now, fields)) {
            Swath swath = swath(before, now, field);
            boolean isNew = opened.stream().noneMatch(each -> each.key().equals(swath.key()));
            if (isNew && opened.size() >= MAX_OPENED) {
                out.reject();
                continue;
            }
            out.accept(swath);
            out.accept(swath.forRobot());
            opened.removeIf(each -> each.key().equals(swath.key()));
            opened.add(new Opened(swath.key(), now.time()));
            covers = true;
        }
        return covers ? before.after(now, opened) : before.at(now);
    }

    private boolean works(WorkReport from, WorkReport to) {
        long time = to.time() - from.time();
        double speed = Swath.distance(from.fix(), to.fix()) / time * MILLIS;
        return from.work() != Work.OFF
                && !Double.isNaN(width(from))
                && time <= rules.maxGap().toMillis()
                && speed > 0
                && speed >= rules.minSpeed()
                && speed <= rules.maxSpeed();
    }

    private double width(WorkReport report) {
        return Double.isNaN(report.width()) ? rules.width() : report.width();
    }

    private static Collection<Field> fields(WorkReport from, WorkReport to, FieldVersions fields) {
        TreeMap<String, Field> all = new TreeMap<>();
        fields.covering(from.fix().position(), to.time()).forEach(field -> all.put(field.id(), field));
        fields.covering(to.fix().position(), to.time()).forEach(field -> all.put(field.id(), field));
        return all.values();
    }

    private Swath swath(Drive before, WorkReport now, Field field) {
        FieldRef ref = FieldRef.of(field);
        WorkReport last = before.last();
        double width = width(last);
        Swath continued = new Swath(
                last.fix(),
                now.fix(),
                ref,
                null,
                before.priorLatitude(),
                before.priorLongitude(),
                before.driven(),
                width,
                false);
        boolean isOpen = before.opened(continued.key())
                .filter(each -> each.time() == last.time())
                .isPresent();
        return isOpen && continued.isContinued()
                ? continued
                : new Swath(
                        last.fix(),
                        now.fix(),
                        ref,
                        new WKBWriter().write(field.area()),
                        Double.NaN,
                        Double.NaN,
                        before.driven(),
                        width,
                        false);
    }
}
