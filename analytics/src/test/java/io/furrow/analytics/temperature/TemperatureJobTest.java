package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Random;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static io.furrow.analytics.temperature.Farm.north;
import static io.furrow.analytics.temperature.Farm.reading;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

@Timeout(60)
class TemperatureJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = InTurn.cluster(2);

    @Test
    void averagesAFieldWithoutItsDefectiveThermometer() throws Exception {
        JobRun run = JobRun.over(Farm.FOUR_DEVICES_ONE_DEFECTIVE);

        JsonNode expected = NgsiJson.read("""
            {"id": "Analytics:FieldTemperature:north", "type": "Analytics:FieldTemperature",
             "field": {"type": "String", "value": "north", "metadata": {}},
             "averageTemperature": {"type": "Float", "value": 19.0, "metadata": {}},
             "plainMean": {"type": "Float", "value": 29.25, "metadata": {}},
             "spread": {"type": "Float", "value": 1.4826, "metadata": {}},
             "devices": {"type": "Integer", "value": 4, "metadata": {}},
             "suspects": {"type": "StructuredValue", "value": ["t4"], "metadata": {}},
             "suspectTypes": {"type": "StructuredValue", "value": ["Thermometer"], "metadata": {}},
             "windowStart": {"type": "Integer", "value": 0, "metadata": {}},
             "windowEnd": {"type": "Integer", "value": 60000, "metadata": {}},
             "quality": {"type": "String", "value": "robust", "metadata": {}},
             "Domain": {"type": "TextUnrestricted", "value": "canary", "metadata": {}}}\
            """.getBytes(UTF_8));
        assertThat(run.records()).hasSize(1);
        TopicRecord result = run.records().get(0);
        assertThat(NgsiJson.read(result.value())).isEqualTo(expected);
        assertThat(result.topic()).isEqualTo(Topics.TEMPERATURE);
        assertThat(new String(result.key(), UTF_8)).isEqualTo("north");
        assertThat(result.timestamp()).as("the window's last instant").isEqualTo(59_999);
        assertThat(result.headers())
                .containsEntry(HeaderNames.CE_SOURCE, "/analytics/temperature")
                .containsEntry(HeaderNames.SERVICE, "farm")
                .containsEntry(HeaderNames.SERVICE_PATH, "/")
                .containsEntry(HeaderNames.CE_TIME, "1970-01-01T00:00:59.999Z");
    }

    @Test
    void countsDevicesOfOneIdAndTwoTypesEach() throws Exception {
        List<TopicRecord> arrivals = new ArrayList<>(Farm.FOUR_DEVICES_ONE_DEFECTIVE);
        arrivals.add(north("Station", "t4", 19, 3_000));
        arrivals.add(north("Station", "t1", 19, 5_000));
        arrivals.add(north("a|b", "c", 19, 5_000));
        arrivals.add(north("a", "b|c", 19, 5_000));

        JobRun run = JobRun.over(arrivals);

        assertThat(run.results(Topics.TEMPERATURE)).singleElement().satisfies(result -> {
            assertThat(result.number("devices")).hasValue(8.0);
            assertThat(result.number("averageTemperature")).hasValue(19.0);
            assertThat(result.value("suspects").orElseThrow()).hasToString("[\"t4\"]");
            assertThat(result.value("suspectTypes").orElseThrow()).hasToString("[\"Thermometer\"]");
        });
    }

    @Test
    void keepsAReplayToItselfAndItsResultsWithIt() throws Exception {
        String replay = "data.hoeing.replay.0a1b2c3d";
        List<TopicRecord> arrivals = new ArrayList<>();
        for (long start = 0; start < 120_000; start += 60_000) {
            for (int device = 1; device <= 4; device++) {
                long time = start + device;
                arrivals.add(north("t" + device, device == 4 ? 18 : 17 + device, time));
                arrivals.add(north("t" + device, device == 4 ? 60 : 17 + device, time)
                        .to(replay));
            }
        }
        TopicRecord same = arrivals.get(0); // also an event of one id is another one there
        arrivals.add(same.to(replay));
        arrivals.add(north("t1", 18, 181_000));
        arrivals.add(north("t2", 18, 1_000).to(replay));

        JobRun run = JobRun.over(arrivals, "--out-of-orderness", "1s");

        assertThat(run.results(Topics.TEMPERATURE))
                .extracting(result -> result.value("suspects").orElseThrow().toString())
                .containsExactly("[]", "[]", "[]");
        assertThat(run.results(replay + ".temperature"))
                .extracting(result -> result.value("suspects").orElseThrow().toString())
                .containsExactly("[\"t4\"]", "[\"t4\"]");
        assertThat(run.to(replay + ".temperature.late")).hasSize(1);
        assertThat(run.records())
                .extracting(TopicRecord::topic)
                .containsOnly(Topics.TEMPERATURE, replay + ".temperature", replay + ".temperature.late");
    }

    @Test
    void givesTheSameResultWhenReadingsArriveOutOfOrder() throws Exception {
        List<TopicRecord> arrivals = new ArrayList<>();
        for (int second = 0; second < 120; second++) {
            arrivals.add(north("t" + second % 4, second % 4 == 3 ? 60 : 18 + second / 40.0, second * 1_000L));
        }
        JobRun inOrder = JobRun.over(arrivals, "--out-of-orderness", "2min");
        Collections.shuffle(arrivals, new Random(1));
        JobRun shuffled = JobRun.over(arrivals, "--out-of-orderness", "2min");

        assertThat(inOrder.results(Topics.TEMPERATURE)).hasSize(2);
        assertThat(shuffled.results(Topics.TEMPERATURE)).isEqualTo(inOrder.results(Topics.TEMPERATURE));
        assertThat(shuffled.records()).hasSize(2);
    }

    @Test
    void countsADeviceOnTheBorderInEveryFieldThatItTouches() throws Exception {
        JobRun run = JobRun.over(List.of(
                reading("border", 10, 57, 15, 1_000),
                reading("corner", 30, 50, 30, 2_000),
                reading("hole", 50, 54, 35, 3_000),
                reading("outside", 70, 49.99, 30, 4_000)));

        assertThat(run.averages())
                .containsExactlyInAnyOrderEntriesOf(Map.of("north", 10.0, "overlap", 10.0, "ring", 40.0));
    }

    @Test
    void givesEachDeviceOneVoteHoweverOftenItReports() throws Exception {
        List<TopicRecord> arrivals = new ArrayList<>(List.of(north("quiet", 20, 30_000)));
        for (int second = 0; second < 59; second++) {
            arrivals.add(north("chatty", second == 0 ? 999 : 10, second * 1_000L));
        }

        JobRun run = JobRun.over(arrivals, "--out-of-orderness", "1min");

        assertThat(run.averages()).containsExactly(Map.entry("north", 15.0));
        Entity result = run.results(Topics.TEMPERATURE).get(0);
        assertThat(result.text("quality")).contains("unverified");
        assertThat(result.number("devices")).contains(2.0);
    }

    @Test
    void correctsAResultWithinTheAllowedLateness() throws Exception {
        JobRun run = JobRun.over(
                List.of(
                        north("t1", 10, 59_000),
                        north("t1", 12, 62_000),
                        north("t2", 30, 59_500),
                        north("t2", 50, 59_600)),
                "--allowed-lateness",
                "10s");

        assertThat(run.to(Topics.TEMPERATURE).stream()
                        .map(JobRun::entity)
                        .filter(result -> result.number("windowStart").orElseThrow() == 0)
                        .map(result -> result.number("averageTemperature").orElseThrow()))
                .containsExactly(10.0, 20.0, 25.0);
        assertThat(run.to(Topics.TEMPERATURE_LATE)).isEmpty();
    }

    @Test
    void slidesItsWindowsWhenAsked() throws Exception {
        JobRun run = JobRun.over(
                List.of(north("t1", 10, 10_000), north("t1", 20, 40_000), north("t1", 30, 70_000)), "--slide", "30s");

        assertThat(run.results(Topics.TEMPERATURE).stream()
                        .map(result -> List.of(
                                result.number("windowStart").orElseThrow(),
                                result.number("averageTemperature").orElseThrow()))
                        .sorted(java.util.Comparator.comparing(row -> row.get(0))))
                .containsExactly(
                        List.of(-30_000.0, 10.0), List.of(0.0, 15.0), List.of(30_000.0, 25.0), List.of(60_000.0, 30.0));
    }

    @Test
    void neverMixesTheDevicesOfTwoTenants() throws Exception {
        Entity warm = JobRun.entity(north("t1", 30, 1_000));
        JobRun run =
                JobRun.over(List.of(north("t1", 10, 1_000), Farm.changed(new FiwareScope("other", "/"), 1_000, warm)));

        assertThat(run.to(Topics.TEMPERATURE))
                .extracting(
                        result -> result.headers().get(HeaderNames.SERVICE),
                        result -> JobRun.entity(result)
                                .number("averageTemperature")
                                .orElseThrow())
                .containsExactlyInAnyOrder(
                        org.assertj.core.groups.Tuple.tuple("farm", 10.0),
                        org.assertj.core.groups.Tuple.tuple("other", 30.0));
    }

    @Test
    void writesToTheTopicsAndReadsTheAttributeThatItsOptionsName() throws Exception {
        TopicRecord moist = Farm.changed(
                Farm.SCOPE,
                1_000,
                Entity.builder("probe", "Probe")
                        .number("Latitude", 52)
                        .number("Longitude", 12)
                        .number("soilMoisture", 0.31)
                        .build());
        JobRun run = JobRun.over(
                List.of(moist, north("t1", 18, 200_000), moist.with(HeaderNames.CE_ID, "another")),
                "--attribute",
                "soilMoisture",
                "--suspect-floor",
                "0.02",
                "--output",
                "data.moisture",
                "--late-output",
                "data.moisture.late");

        assertThat(run.results("data.moisture")).hasSize(1);
        Entity result = run.results("data.moisture").get(0);
        assertThat(result.id()).isEqualTo("Analytics:FieldSoilMoisture:north");
        assertThat(result.type()).isEqualTo("Analytics:FieldSoilMoisture");
        assertThat(result.number("averageSoilMoisture"))
                .hasValueSatisfying(value -> assertThat(value).isCloseTo(0.31, within(1e-12)));
        assertThat(run.to("data.moisture.late")).hasSize(1);
    }
}
