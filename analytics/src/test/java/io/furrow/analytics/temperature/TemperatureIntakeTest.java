package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static io.furrow.analytics.temperature.Farm.north;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Timeout(60)
class TemperatureIntakeTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = InTurn.rememberingCluster(2);

    @Test
    void countsReadingsFromOutsideOfAllFields() throws Exception {
        JobRun run = JobRun.over(List.of(Farm.reading("near", 70, 49.99, 30, 4_000), north("t1", 18, 4_000)));

        assertThat(run.averages()).containsOnlyKeys("north");
        assertThat(counted(run, "outside")).isEqualTo(1);
    }

    @Test
    void countsARepeatedEventOnce() throws Exception {
        TopicRecord first = north("t1", 10, 1_000);
        TopicRecord last = north("t1", 30, 3_000);

        assertThat(JobRun.over(List.of(first, north("t1", 11, 2_000), last)).averages())
                .containsEntry("north", 11.0);
        JobRun repeated = JobRun.over(List.of(first, north("t1", 11, 2_000), last, first, first, first));
        assertThat(repeated.averages()).containsExactly(Map.entry("north", 11.0));
        assertThat(counted(repeated, "repeated")).isEqualTo(3);
    }

    @Test
    void sendsWhatComesTooLateToItsOwnTopicUnchanged() throws Exception {
        TopicRecord inTime = north("t1", 10, 59_000);
        TopicRecord next = north("t1", 12, 62_000);
        TopicRecord late = north("t2", 90, 59_999);

        assertThat(JobRun.over(List.of(inTime, late, next)).to(Topics.TEMPERATURE_LATE))
                .isEmpty();
        JobRun run = JobRun.over(List.of(inTime, next, late));

        assertThat(run.averages()).as("of both windows the second").containsEntry("north", 12.0);
        assertThat(run.results(Topics.TEMPERATURE))
                .extracting(result -> result.number("averageTemperature").orElseThrow())
                .containsExactly(10.0, 12.0);
        assertThat(run.to(Topics.TEMPERATURE_LATE)).hasSize(1);
        TopicRecord set = run.to(Topics.TEMPERATURE_LATE).get(0);
        assertThat(set.key()).isEqualTo(late.key());
        assertThat(set.value()).isEqualTo(late.value());
        assertThat(set.timestamp()).isEqualTo(late.timestamp());
        assertThat(set.headers())
                .containsAllEntriesOf(late.headers())
                .containsEntry("late-field", "north")
                .containsEntry("late-window", "1970-01-01T00:00:00Z/1970-01-01T00:01:00Z");
        assertThat(counted(run, "late")).isEqualTo(1);
    }

    @Test
    void setsGarbageAsideAndLeavesTheRestUnharmed() throws Exception {
        List<TopicRecord> arrivals = new ArrayList<>(Farm.FOUR_DEVICES_ONE_DEFECTIVE);
        byte[] noJson = "temperature=18".getBytes(UTF_8);
        byte[] otherSchema = "{\"sensor\": 5, \"readings\": [18.1]}".getBytes(UTF_8);
        arrivals.add(1, Farm.garbage(noJson, 1_500).to("reports"));
        arrivals.add(2, Farm.garbage(otherSchema, 1_500).to("reports"));
        arrivals.add(3, Farm.garbage(noJson, 1_500));

        JobRun run = JobRun.over(arrivals);

        assertThat(run.averages()).containsExactly(Map.entry("north", 19.0));
        assertThat(run.to("data.raw.dead")).as("ingest writes it").isEmpty();
        assertThat(run.to("reports.dead")).hasSize(2);
        TopicRecord first = run.to("reports.dead").stream()
                .filter(dead -> java.util.Arrays.equals(dead.value(), noJson))
                .findFirst()
                .orElseThrow();
        assertThat(first.headers())
                .containsAllEntriesOf(Map.of(DeadLetter.REASON, "not-json", DeadLetter.STAGE, "temperature"));
        assertThat(counted(run, "rejected")).isEqualTo(3);
    }

    @Test
    void passesOverWhatIsNoReadingAndCountsIt() throws Exception {
        TopicRecord deletion = TopicRecord.of(Topics.RAW, 1_000, "t1", null, Map.of());
        List<TopicRecord> arrivals = new ArrayList<>(List.of(
                deletion,
                thermometer("Analytics:Something", "12", 52, 12),
                thermometer("Thermometer", "warm", 52, 12),
                thermometer("Thermometer", "1e200", 52, 12),
                thermometer("Thermometer", "12", 0, 0),
                thermometer("Thermometer", "12", 152, 12),
                Farm.changed(
                        Farm.SCOPE,
                        1_000,
                        Entity.builder("t", "Thermometer")
                                .number("Temperature", 12)
                                .build()),
                Farm.changed(
                        Farm.SCOPE,
                        1_000,
                        Entity.builder("c", "Camera").text("Image", "…").build())));
        arrivals.addAll(Farm.FOUR_DEVICES_ONE_DEFECTIVE);
        arrivals.add(thermometer("Thermometer", " 19.0", 52, 12));

        JobRun run = JobRun.over(arrivals);

        assertThat(run.averages()).containsExactly(Map.entry("north", 19.0));
        assertThat(run.records()).hasSize(1);
        assertThat(counted(run, "accepted")).isEqualTo(5);
        assertThat(counted(run, "skipped")).isEqualTo(3);
        assertThat(counted(run, "faulty")).isEqualTo(4);
        assertThat(counted(run, "unlocated")).isEqualTo(1);
    }

    private static TopicRecord thermometer(String type, String temperature, double latitude, double longitude) {
        Entity entity = Entity.builder("t2", type)
                .text("Temperature", temperature)
                .number("Latitude", latitude)
                .number("Longitude", longitude)
                .build();
        return Farm.changed(Farm.SCOPE, 1_000, entity);
    }

    private static long counted(JobRun run, String counter) {
        return InTurn.counted(run.id(), counter);
    }
}
