package io.furrow.flink.job;

import java.util.HashMap;
import java.util.Map;
import java.util.function.Function;

import org.apache.flink.metrics.MetricGroup;

/**
 * Meters per domain and mission, in the groups {@code domain=<name>}, {@code mission=<name>}. The first so many pairs have
 * meters of their own; all others share those of domain and mission {@value #OTHERS}, because a reporter keeps what it has
 * once seen.
 */
public final class PerMissionMetrics<M> {
    /** Pairs with meters of their own, per subtask, where nothing else is requested. */
    public static final int USUAL_LIMIT = 100;

    private static final String OTHERS = "others";
    /** What stands for no name: a reporter may take none for a fault. */
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
