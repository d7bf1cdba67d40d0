package io.furrow.analytics.collision;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static io.furrow.analytics.collision.ReportedRun.START;
import static io.furrow.analytics.collision.ReportedRun.options;
import static io.furrow.analytics.collision.ReportedRun.robot;
import static org.assertj.core.api.Assertions.assertThat;

/** Two robots stand side by side and report once a second; the clock of one is 3 s behind, the out-of-orderness is 2 s. */
class ClockJobTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.create();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2, METRICS.addToConfiguration(new Configuration()));

    @Test
    void saysThatTheSlowOneIsLeftOut() throws Exception {
        List<TopicRecord> written = run(100);

        assertThat(entities(written, "data.collision")).isEmpty();
        List<Entity> behind = entities(written, "data.clocks");
        assertThat(behind).hasSize(2).allSatisfy(entity -> {
            assertThat(entity.id()).isEqualTo("Analytics:ClockBehind:slow");
            assertThat(entity.type()).isEqualTo("Analytics:ClockBehind");
            assertThat(entity.text("device")).contains("slow");
            assertThat(entity.text("deviceType")).isPresent();
            assertThat(entity.text("job")).contains("collision");
            assertThat(entity.text("Mission")).contains("hoeing");
            assertThat(entity.number("late")).hasValue(999.0);
            assertThat(entity.number("interval")).hasValue(60_000.0);
        });
        assertThat(behind.get(0).number("positions")).hasValue(31.0);
        assertThat(behind.get(0).number("time")).hasValue(START + 30_000 - 2001.0);
    }

    @Test
    void findsTheEncounterOnceTheClockIsCorrected() throws Exception {
        List<TopicRecord> written = run(200, "--clock-correction", "on");

        List<Entity> found = entities(written, "data.collision");
        assertThat(found.get(0).text("phase")).contains("started");
        assertThat(found.get(0).number("startTime")).hasValue(START + 122_000.0);
        assertThat(found.get(found.size() - 1).text("phase")).contains("ended");
        assertThat(entities(written, "data.clocks"))
                .filteredOn(entity -> entity.type().equals("Analytics:ClockOffset"))
                .singleElement()
                .satisfies(entity -> {
                    assertThat(entity.id()).isEqualTo("Analytics:ClockOffset:slow");
                    assertThat(entity.number("offset")).hasValue(3000.0);
                });
    }

    @Test
    void setsAsideWhatIsFromTheFuture() throws Exception {
        long future = System.currentTimeMillis() + Duration.ofHours(2).toMillis() - START;
        TopicRecord foreign = robot("foreign", 0, future);

        List<TopicRecord> written = ReportedRun.run(
                options("--parallelism", "1"), foreign.to("reports"), foreign, robot("r1", 0, 0), robot("r2", 2, 0));

        assertThat(written)
                .filteredOn(record -> record.headers().containsKey(DeadLetter.REASON))
                .singleElement()
                .satisfies(dead -> {
                    assertThat(dead.topic()).isEqualTo("reports.dead");
                    assertThat(dead.headers()).containsEntry(DeadLetter.REASON, "from-the-future");
                    assertThat(dead.timestamp()).isLessThan(foreign.timestamp());
                });
    }

    private static List<TopicRecord> run(int seconds, String... more) throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second < seconds; second++) {
            long now = 1000L * second;
            String received = Long.toString(START + now);
            records.add(robot("right", 0, now).with(HeaderNames.TS_SOURCE, received));
            records.add(robot("slow", 2, now - 3000).with(HeaderNames.TS_SOURCE, received));
        }
        String[] all =
                Stream.concat(Stream.of("--parallelism", "1"), Stream.of(more)).toArray(String[]::new);
        return ReportedRun.runAfterDevices(options(all), () -> METRICS, records.toArray(TopicRecord[]::new));
    }

    private static List<Entity> entities(List<TopicRecord> written, String topic) {
        return written.stream()
                .filter(record -> record.topic().equals(topic))
                .map(ReportedRun::entity)
                .toList();
    }
}
