package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;

import static io.furrow.analytics.collision.ReportedRun.options;
import static io.furrow.analytics.collision.ReportedRun.robot;
import static io.furrow.analytics.collision.ReportedRun.run;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class EagerJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setNumberTaskManagers(1)
            .setNumberSlotsPerTaskManager(2)
            .build());

    /** r2 has been far away when r1 was where r2 is now: known only when the late report comes. */
    @Test
    void confirmsWhatHasComeTrueAndWithdrawsWhatHasNot() throws Exception {
        List<Entity> told = collisions(run(
                options("--eager", "--parallelism", "1"),
                robot("r1", 0, 0),
                robot("r2", 4, 100),
                robot("r2", 50, 2000),
                robot("r3", 500, 2000),
                robot("r1", 50, 4000),
                robot("r4", 502, 4500),
                robot("r3", 900, 4400)));

        Entity provisional = withPhase(told, "provisional").get(0);
        Entity start = withPhase(told, "started").get(0);
        assertThat(start.text("confirms")).isEqualTo(provisional.text("encounter"));
        assertThat(withPhase(told, "provisional")).hasSize(3);
        assertThat(withPhase(told, "withdrawn"))
                .singleElement()
                .satisfies(withdrawn -> assertThat(withdrawn.text("Device1_ID")).contains("r3"))
                .satisfies(withdrawn -> assertThat(withdrawn.text("encounter"))
                        .isEqualTo(withPhase(told, "provisional").get(2).text("encounter")));
    }

    @Test
    void resolvesEachProvisionalRecordOnceAndLeavesTheExactOnesAsTheyAre() throws Exception {
        Random random = new Random(20261121);
        List<TopicRecord> reported = new ArrayList<>();
        for (int i = 0; i < 600; i++) {
            double east = 6 * random.nextGaussian();
            reported.add(robot("r" + random.nextInt(6), east, 100L * i - random.nextInt(1500)));
        }
        TopicRecord[] reports = reported.toArray(TopicRecord[]::new);

        List<Entity> told = collisions(run(options("--eager", "--parallelism", "1"), reports));

        List<String> resolved = new ArrayList<>();
        told.forEach(each -> each.text("confirms").ifPresent(resolved::add));
        assertThat(resolved).hasSizeGreaterThan(20);
        withPhase(told, "withdrawn")
                .forEach(each -> resolved.add(each.text("encounter").orElseThrow()));
        assertThat(resolved)
                .hasSizeGreaterThan(50)
                .containsExactlyInAnyOrderElementsOf(withPhase(told, "provisional").stream()
                        .map(each -> each.text("encounter").orElseThrow())
                        .toList());
        List<Entity> exact = collisions(run(options("--parallelism", "1"), reports));
        assertThat(told.stream().filter(EagerJobTest::isExact).map(EagerJobTest::transition))
                .containsExactlyInAnyOrderElementsOf(
                        exact.stream().map(EagerJobTest::transition).toList());
    }

    private static boolean isExact(Entity told) {
        return List.of("started", "ongoing", "ended")
                .contains(told.text("phase").orElseThrow());
    }

    private static String transition(Entity told) {
        return told.text("encounter").orElseThrow()
                + told.text("phase")
                + told.number("time")
                + told.number("minDistance");
    }

    private static List<Entity> withPhase(List<Entity> told, String phase) {
        return told.stream()
                .filter(each -> each.text("phase").orElseThrow().equals(phase))
                .toList();
    }

    private static List<Entity> collisions(List<TopicRecord> written) {
        return written.stream()
                .filter(record -> record.topic().equals("data.collision"))
                .map(ReportedRun::entity)
                .toList();
    }
}
