package io.furrow.flink.job;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.metrics.groups.UnregisteredMetricsGroup;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class PerMissionMetricsTest {
    private final List<String> groups = new ArrayList<>();
    private final PerMissionMetrics<Object> meters =
            new PerMissionMetrics<>(new NotingGroup(), 2, group -> new Object());

    @Test
    void keepsTheMetersOfEachPair() {
        Object weeding = meters.of("north", "weeding");

        assertThat(meters.of("north", "weeding")).isSameAs(weeding);
        assertThat(meters.of("north", "")).isNotSameAs(weeding);
        assertThat(groups).containsExactly("domain=north", "mission=weeding", "domain=north", "mission=none");
    }

    @Test
    void countsTogetherWhatIsBeyondTheLimit() {
        Object first = meters.of("a", "a");
        meters.of("b", "b");

        assertThat(meters.of("c", "c"))
                .isSameAs(meters.of("d", ""))
                .isSameAs(meters.of("a", "c"))
                .isNotSameAs(first);
        assertThat(meters.of("a", "a")).isSameAs(first);
        assertThat(groups).endsWith("domain=others", "mission=others").hasSize(6);
    }

    private final class NotingGroup extends UnregisteredMetricsGroup {
        @Override
        public MetricGroup addGroup(String key, String value) {
            groups.add(key + "=" + value);
            return this;
        }
    }
}
