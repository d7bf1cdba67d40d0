package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class CollisionReportTest {
    private static final CollisionReport.Plan PLAN =
            new CollisionReport.Plan(10, 1, Duration.ofSeconds(1), Duration.ofSeconds(1));
    private static final RedisGeo.Result SAME = new RedisGeo.Result(500, 40, 40);

    @Test
    void agreesWhereAllFindTheSame() {
        assertThat(new CollisionReport(List.of(run(SAME, 3, 0))).agrees()).isTrue();
        assertThat(new CollisionReport(List.of(run(null, 3, 0))).agrees()).isTrue();
        assertThat(new CollisionReport(List.of(run(SAME, 3, 0), run(new RedisGeo.Result(500, 39, 40), 3, 0))).agrees())
                .isFalse();
        assertThat(new CollisionReport(List.of(run(SAME, 3, 1))).agrees()).isFalse();
        assertThat(new CollisionReport(List.of(run(SAME, 0, 0))).agrees()).isFalse();
    }

    @Test
    void saysThatThereIsNoRedis() {
        assertThat(figure(SAME, "Redis GEO")).isEqualTo("500.0");
        assertThat(figure(SAME, "pairs")).isEqualTo("40/40");
        assertThat(figure(null, "Redis GEO")).isEqualTo("not installed");
    }

    private static String figure(RedisGeo.Result redis, String name) {
        return new CollisionReport(List.of(run(redis, 3, 0)))
                .figures()
                .json()
                .get(0)
                .get(name)
                .asText();
    }

    private static CollisionReport.Run run(RedisGeo.Result redis, int compared, int different) {
        return new CollisionReport.Run(PLAN, 1_000, 1, 1, 1, 2_000, redis, compared, different);
    }
}
