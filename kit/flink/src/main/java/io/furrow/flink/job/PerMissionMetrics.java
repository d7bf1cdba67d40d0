package io.furrow.flink.job;

import java.util.HashMap;
import java.util.Map;
import java.util.function.Function;

import org.apache.flink.metrics.MetricGroup;

/**
 * Meters per domain and mission, in the groups {@code domain=<name>}, {@code mission=<name>}. A limited number of pairs
 * have their own meters; all others share those of domain and mission {@value #OTHERS}, because a reporter never drops a
 * metric.
 */
public final class PerMissionMetrics<M> {
    /** Default number of pairs with their own meters, per subtask. */
    public static final int USUAL_LIMIT = 100;

    private static final String OTHERS = "others";
    /** Replaces an empty name, which a reporter may reject. */
    private static final String NONE = "none";

    private final MetricGroup group;
    private final int atMost;
    private final Function<MetricGroup, M> making;
    private final Map<String, Map<String, M>> meters = new HashMap<>();
    private int pairs;
    private M others;

    /** @param making registers the meters of one pair in its group */
    public PerMissionMetrics(MetricGroup group, int atMost, Function<MetricGroup, M> making) {
        this.group = group;
        this.atMost = atMost;
        this.making = making;
    }

    /** The meters of a pair; each name may be empty. */
    public M of(String domain, String mission) {
        Map<String, M> missions = meters.get(domain);
        M known = missions == null ? null : missions.get(mission);
        return known == null ? first(domain, mission) : known;
    }

    private M first(String domain, String mission) {
        if (pairs < atMost) {
            pairs++;
            M made = making.apply(group(domain, mission));
            meters.computeIfAbsent(domain, name -> new HashMap<>()).put(mission, made);
            return made;
        }
        if (others == null) {
            others = making.apply(group(OTHERS, OTHERS));
        }
        return others;
    }

    private MetricGroup group(String domain, String mission) {
        return group.addGroup("domain", domain.isEmpty() ? NONE : domain)
                .addGroup("mission", mission.isEmpty() ? NONE : mission);
    }
}
