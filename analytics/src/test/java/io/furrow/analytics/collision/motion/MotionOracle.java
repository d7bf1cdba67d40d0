package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.DoubleUnaryOperator;

import io.furrow.analytics.collision.encounter.PairId;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.position.PositionFix;

/** The definition of this package as code: every pair at every instant; the closest found by search, not by a formula. */
public final class MotionOracle {
    public static final Comparator<Told> ORDER = Comparator.comparingLong(Told::time)
            .thenComparing(Told::pair)
            .thenComparing(Told::phase)
            .thenComparing(Told::start);

    private final MotionRules rules;
    private final List<Told> told = new ArrayList<>();

    /** What of a record has to agree. */
    public record Told(Phase phase, String pair, long start, long time, double dcpa) {
        public static Told of(Approach approach) {
            return new Told(
                    approach.phase(), approach.pairId(), approach.startTime(), approach.time(), approach.dcpa());
        }

        /** The place of a minimum is found by search to a fraction of a second only, its depth to a millimeter. */
        public boolean agreesWith(Told other) {
            boolean crossed = phase == Phase.CROSSED;
            return phase == other.phase
                    && pair.equals(other.pair)
                    && Math.abs(start - other.start) <= (crossed ? 1 : 0)
                    && Math.abs(time - other.time) <= (crossed ? 200 : 0)
                    && Math.abs(dcpa - other.dcpa) < 1e-3;
        }
    }

    private MotionOracle(MotionRules rules) {
        this.rules = rules;
    }

    public static List<Told> of(Collection<PositionFix> accepted, MotionRules rules) {
        MotionOracle oracle = new MotionOracle(rules);
        Map<String, TreeMap<Long, PositionFix>> devices = new TreeMap<>();
        accepted.stream()
                .sorted(PositionFix.SEQUENCE)
                .forEach(fix ->
                        devices.computeIfAbsent(fix.id(), id -> new TreeMap<>()).put(fix.time(), fix));
        List<String> ids = new ArrayList<>(devices.keySet());
        for (int i = 0; i < ids.size(); i++) {
            for (int j = i + 1; j < ids.size(); j++) {
                oracle.pair(devices.get(ids.get(i)), devices.get(ids.get(j)));
            }
        }
        oracle.told.sort(ORDER);
        return oracle.told;
    }

    private void pair(TreeMap<Long, PositionFix> a, TreeMap<Long, PositionFix> b) {
        TreeSet<Long> instants = new TreeSet<>(a.keySet());
        instants.addAll(b.keySet());
        predictions(a, b, instants);
        crossings(a, b, instants);
    }

    private void predictions(TreeMap<Long, PositionFix> a, TreeMap<Long, PositionFix> b, TreeSet<Long> instants) {
        long start = 0;
        long held = Long.MIN_VALUE / 2;
        long reported = 0;
        for (long now : instants) {
            PositionFix first = last(a, now);
            PositionFix second = last(b, now);
            CartesianPoint v = first == null ? null : velocity(a, first);
            CartesianPoint w = second == null ? null : velocity(b, second);
            if (v == null || w == null || isClose(first, second) || first.sharesAggregateWith(second)) {
                continue;
            }
            DoubleUnaryOperator distance = t -> CartesianPoint.of(first)
                    .plus(v.times(t - first.time()))
                    .minus(CartesianPoint.of(second).plus(w.times(t - second.time())))
                    .length();
            double end = Math.min(first.time(), second.time()) + rules.horizon().toMillis();
            double dcpa = end < now ? Double.MAX_VALUE : distance.applyAsDouble(lowest(distance, now, end));
            if (dcpa > threshold(first, second)) {
                continue;
            }
            boolean goesOn = now - held < rules.horizon().toMillis();
            start = goesOn ? start : now;
            if (!goesOn || now - reported >= rules.common().ongoingEvery().toMillis()) {
                reported = now;
                told.add(new Told(Phase.PREDICTED, pair(first, second), start, now, dcpa));
            }
            held = now;
        }
    }

    private void crossings(TreeMap<Long, PositionFix> a, TreeMap<Long, PositionFix> b, TreeSet<Long> instants) {
        double from = Double.NaN;
        double nearest = Double.MAX_VALUE;
        double closest = 0;
        boolean close = false;
        Long before = null;
        for (Long now : instants) {
            boolean linked = before != null
                    && covers(a, before, now)
                    && covers(b, before, now)
                    && !a.higherEntry(before)
                            .getValue()
                            .sharesAggregateWith(b.higherEntry(before).getValue());
            if (linked) {
                DoubleUnaryOperator distance = t -> at(a, t).minus(at(b, t)).length();
                double threshold = threshold(
                        a.higherEntry(before).getValue(), b.higherEntry(before).getValue());
                double lowest = lowest(distance, before, now);
                boolean near = distance.applyAsDouble(lowest) <= threshold;
                if (near && Double.isNaN(from)) {
                    from = edge(distance, threshold, before, lowest);
                    nearest = Double.MAX_VALUE;
                    close = false;
                }
                if (near) {
                    close |= isClose(last(a, before), last(b, before)) || isClose(last(a, now), last(b, now));
                    closest = distance.applyAsDouble(lowest) < nearest ? lowest : closest;
                    nearest = Math.min(nearest, distance.applyAsDouble(lowest));
                }
                if (near && distance.applyAsDouble(now) > threshold) {
                    tell(a, b, close, new double[] {from, closest, nearest});
                    from = Double.NaN;
                }
            }
            boolean goesOn = a.higherKey(now) != null
                    && b.higherKey(now) != null
                    && covers(a, now, instants.higher(now))
                    && covers(b, now, instants.higher(now));
            if (!goesOn && !Double.isNaN(from)) {
                tell(a, b, close, new double[] {from, closest, nearest});
                from = Double.NaN;
            }
            before = now;
        }
    }

    private void tell(TreeMap<Long, PositionFix> a, TreeMap<Long, PositionFix> b, boolean close, double[] found) {
        if (!close) {
            PositionFix first = a.firstEntry().getValue();
            PositionFix second = b.firstEntry().getValue();
            long start = (long) Math.floor(found[0]);
            told.add(new Told(Phase.CROSSED, pair(first, second), start, (long) found[1], found[2]));
        }
    }

    private PositionFix last(TreeMap<Long, PositionFix> fixes, long now) {
        var entry = fixes.floorEntry(now);
        return entry == null || now >= entry.getKey() + rules.timeToLive() ? null : entry.getValue();
    }

    /** Whether a segment behind, not too long and not too fast, covers the time. */
    private boolean covers(TreeMap<Long, PositionFix> fixes, long from, long until) {
        var start = fixes.floorEntry(from);
        var end = fixes.ceilingEntry(until);
        if (start == null || end == null || fixes.higherKey(start.getKey()).longValue() != end.getKey()) {
            return false;
        }
        long length = end.getKey() - start.getKey();
        double meters = CartesianPoint.of(start.getValue())
                .minus(CartesianPoint.of(end.getValue()))
                .length();
        return length < rules.timeToLive() && 1000 * meters / length <= rules.maxSpeed();
    }

    private static CartesianPoint at(TreeMap<Long, PositionFix> fixes, double time) {
        long floor = (long) Math.floor(time);
        var start = fixes.floorEntry(floor);
        var end = fixes.higherEntry(floor);
        if (end == null || start.getKey() == time) {
            return CartesianPoint.of(start.getValue());
        }
        double share = (time - start.getKey()) / (end.getKey() - start.getKey());
        CartesianPoint from = CartesianPoint.of(start.getValue());
        return from.plus(CartesianPoint.of(end.getValue()).minus(from).times(share));
    }

    private CartesianPoint velocity(TreeMap<Long, PositionFix> fixes, PositionFix fix) {
        CartesianPoint there = CartesianPoint.of(fix);
        CartesianPoint velocity;
        if (fix.speed() == 0) {
            velocity = new CartesianPoint(0, 0, 0);
        } else if (!Double.isNaN(fix.speed()) && !Double.isNaN(fix.heading())) {
            velocity = CartesianPoint.heading(fix, fix.heading()).times(fix.speed() / 1000);
        } else {
            var before = fixes.lowerEntry(fix.time());
            if (before == null || fix.time() >= before.getKey() + rules.timeToLive()) {
                return null;
            }
            velocity = there.minus(CartesianPoint.of(before.getValue())).times(1.0 / (fix.time() - before.getKey()));
            velocity = velocity.alongTheGroundAt(there);
        }
        return 1000 * velocity.length() > rules.maxSpeed() ? null : velocity;
    }

    private boolean isClose(PositionFix a, PositionFix b) {
        return a != null && b != null && CartesianPoint.of(a).distance(CartesianPoint.of(b)) <= threshold(a, b);
    }

    private double threshold(PositionFix a, PositionFix b) {
        return rules.common().thresholds().between(a.type(), b.type());
    }

    private static String pair(PositionFix a, PositionFix b) {
        return PairId.of(a.identity(), b.identity());
    }

    /** Where a convex function is least: golden sections would do the same with fewer calls. */
    private static double lowest(DoubleUnaryOperator distance, double from, double until) {
        double low = from;
        double high = until;
        for (int i = 0; i < 100; i++) {
            double third = (high - low) / 3;
            if (distance.applyAsDouble(low + third) < distance.applyAsDouble(high - third)) {
                high -= third;
            } else {
                low += third;
            }
        }
        double middle = (low + high) / 2;
        double best = distance.applyAsDouble(from) <= distance.applyAsDouble(middle) ? from : middle;
        return distance.applyAsDouble(until) < distance.applyAsDouble(best) ? until : best;
    }

    private static double edge(DoubleUnaryOperator distance, double threshold, double from, double near) {
        if (distance.applyAsDouble(from) <= threshold) {
            return from;
        }
        double out = from;
        double in = near;
        for (int i = 0; i < 100; i++) {
            double middle = (out + in) / 2;
            if (distance.applyAsDouble(middle) <= threshold) {
                in = middle;
            } else {
                out = middle;
            }
        }
        return in;
    }
}
