package io.furrow.analytics.collision;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine.ParameterException;

import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.JobUids;
import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static io.furrow.analytics.collision.ReportedRun.START;
import static io.furrow.analytics.collision.ReportedRun.entity;
import static io.furrow.analytics.collision.ReportedRun.options;
import static io.furrow.analytics.collision.ReportedRun.placed;
import static io.furrow.analytics.collision.ReportedRun.record;
import static io.furrow.analytics.collision.ReportedRun.robot;
import static io.furrow.analytics.collision.ReportedRun.run;
import static io.furrow.analytics.collision.ReportedRun.runAfterDevices;
import static io.furrow.analytics.collision.ReportedRun.text;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;

class CollisionJobTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.create();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2, METRICS.addToConfiguration(new Configuration()));

    @Test
    void tellsTheLifeOfAnEncounterAsEntitiesOfItsPair() throws Exception {
        List<TopicRecord> written = run(
                options(),
                robot("r1", 0, 0),
                robot("r2", 100, 0),
                robot("r2", 4, 1000),
                robot("r2", 2, 2500),
                robot("r2", 3, 2600),
                robot("r2", 50, 4000));

        assertThat(written).extracting(TopicRecord::topic).containsOnly("data.collision");
        assertThat(written)
                .extracting(
                        TopicRecord::timestamp,
                        record -> entity(record).text("phase").orElseThrow())
                .containsExactly(
                        tuple(START + 1000, "started"), tuple(START + 2500, "ongoing"), tuple(START + 4000, "ended"));
        assertThat(written)
                .extracting(record -> entity(record).id())
                .containsOnly(entity(written.get(0)).id());
        TopicRecord end = written.get(2);
        assertThat(new String(end.key(), UTF_8)).isEqualTo("r1-r2");
        assertThat(entity(end).number("minDistance"))
                .hasValueSatisfying(d -> assertThat(d).isBetween(1.99, 2.01));
        assertThat(entity(end).number("distance"))
                .hasValueSatisfying(d -> assertThat(d).isBetween(2.99, 3.01));
        assertThat(entity(end).text("Device2_Mission")).contains("hoeing");
        assertThat(end.headers())
                .containsAllEntriesOf(Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/north"))
                .containsKey(HeaderNames.CE_ID);
    }

    @Test
    void takesTheThresholdFromItsOption() throws Exception {
        TopicRecord[] apart = {robot("r1", 0, 0), robot("r2", 7, 0)};
        assertThat(run(options("--threshold", "10"), apart)).hasSize(2);
        assertThat(run(options(), apart)).isEmpty();
    }

    @Test
    void goesByTheTypesZonesAndLimitsOfItsOptions(@TempDir Path folder) throws Exception {
        PositionFix corner = Fixes.east("", 20, 0);
        Path yard = Files.writeString(folder.resolve("yard.geojson"), """
            {"features": [{"geometry": {"type": "Polygon", "coordinates":
              [[[%1$s, -1], [11, -1], [11, 1], [%1$s, 1], [%1$s, -1]]]}}]}\
            """.formatted(corner.longitude()));
        TopicRecord[] reported = {
            robot("r1", 0, 0),
            robot("r2", 7, 0),
            robot("r3", 100, 0),
            robot("r4", 100, 0),
            robot("r5", 9, 1000),
            robot("r1", 0, 2000)
        };
        String[] all = {"--threshold-of", "ROBOT=10", "--zones", yard.toString(), "--crowd", "1"};

        List<TopicRecord> written = run(options(all), reported);

        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.collision"))
                .as("r3 and r4 are in the yard, r5 is nearer to r2 than to r1")
                .extracting(record -> new String(record.key(), UTF_8))
                .containsOnly("r1-r2", "r2-r5");
        TopicRecord overflow = written.stream()
                .filter(record -> record.topic().equals("data.collision.overflow"))
                .findFirst()
                .orElseThrow();
        assertThat(overflow.timestamp()).isEqualTo(START + 1000);
        assertThat(entity(overflow).type()).isEqualTo("Analytics:CollisionOverflow");
        assertThat(entity(overflow).number("pairs")).hasValue(3.0);
        assertThat(entity(overflow).number("pairsLeftOut")).hasValue(1.0);
        assertThat(entity(overflow).number("nearest")).hasValue(1.0);
        assertThat(entity(overflow).number("devices")).hasValue(3.0);
        assertThat(entity(overflow).id())
                .isEqualTo("Analytics:CollisionOverflow:"
                        + entity(overflow).text("cell").orElseThrow());
    }

    @Test
    void addsAStageWhereEncountersAreToBeSteady() throws Exception {
        TopicRecord[] passing = {robot("r1", 0, 0), robot("r2", 4, 0), robot("r2", 9, 500), robot("r2", 11, 1000)};
        assertThat(run(options("--leave-factor", "2"), passing))
                .extracting(TopicRecord::timestamp)
                .containsExactly(START, START + 1000);
        assertThat(run(options("--leave-factor", "2", "--dwell", "900ms"), passing))
                .extracting(TopicRecord::timestamp)
                .containsExactly(START + 900, START + 1000);
        assertThat(run(options("--leave-factor", "2", "--dwell", "1s"), passing))
                .isEmpty();
        assertThat(JobUids.of(CollisionJob.assemble(options("--dwell", "1s")))).contains("debounce-encounters");
    }

    @Test
    void setsAsideWhatIsUnreadableAndLateAndDetectsAmongTheRest() throws Exception {
        // One subtask, so that the watermark is behind no channel when the late position comes.
        TopicRecord garbage = record("x", 0, "{not json");
        TopicRecord ofIngest = record("y", 0, "{not json either");
        List<TopicRecord> written = runAfterDevices(
                options("--parallelism", "1"),
                () -> METRICS,
                robot("r1", 0, 0),
                garbage.to("reports"),
                ofIngest,
                robot("r2", 2, 0),
                robot("r9", 900, 90_000),
                robot("r3", 2, 50));

        assertThat(written)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.collision", "data.collision", "data.collision.late", "reports.dead");
        assertThat(written)
                .filteredOn(record -> record.topic().equals("reports.dead"))
                .singleElement()
                .satisfies(dead -> assertThat(dead.headers())
                        .containsAllEntriesOf(Map.of(DeadLetter.STAGE, "collision", DeadLetter.REASON, "not-json")));
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.collision.late"))
                .singleElement()
                .satisfies(late -> {
                    assertThat(entity(late).id()).isEqualTo("r3");
                    assertThat(late.timestamp()).isEqualTo(START + 50);
                });
    }

    @Test
    void leavesOutWhatHasNoUsablePositionResultsAndPartsOfOneRobot() throws Exception {
        EntityBuilder result = Entity.builder("Analytics:Collision:1", "Analytics:Collision");
        EntityBuilder nowhere =
                Entity.builder("r4", "ROBOT").number("Latitude", 0).number("Longitude", 0);
        EntityBuilder silent = Entity.builder("r5", "ROBOT").text("Mission", "hoeing");
        EntityBuilder camera = Entity.builder("c1", "Camera").text("carriedBy", "r1");
        List<TopicRecord> written = run(
                options(),
                robot("r1", 0, 0),
                record("r4", 0, text(nowhere)),
                record("r5", 0, text(silent)),
                record("r6", 0, null),
                record("a", 0, text(placed(result, 1))),
                record("c1", 0, text(placed(camera, 1))),
                robot("r2", 2, 0));

        // The camera on the first robot is also close to the second: two pairs, each with a start and an end.
        assertThat(written)
                .extracting(record -> new String(record.key(), UTF_8))
                .containsExactlyInAnyOrder("c1-r2", "c1-r2", "r1-r2", "r1-r2");
    }

    @Test
    void asksServiceDevicesWhatCarriesADevice() throws Exception {
        List<TopicRecord> written = run(options(), robot("r1", 0, 0), robot("l1", 1, 0), robot("r2", 2, 0));
        assertThat(written)
                .extracting(record -> new String(record.key(), UTF_8))
                .containsExactlyInAnyOrder("l1-r2", "l1-r2", "r1-r2", "r1-r2");
        List<TopicRecord> before = run(options(), robot("r1", 0, -9), robot("l1", 1, -9), robot("r2", 2, -9));
        assertThat(before)
                .as("as of the position's time")
                .extracting(record -> new String(record.key(), UTF_8))
                .containsExactlyInAnyOrder("l1-r1", "l1-r1", "r1-r2", "r1-r2");
    }

    @Test
    void keepsAReplayToItselfAndItsResultsWithIt() throws Exception {
        String replay = "data.hoeing.replay.0a1b2c3d";
        List<TopicRecord> written = run(
                options(),
                robot("r1", 0, 0),
                robot("r2", 2, 0).to(replay),
                robot("r3", 4, 0).to(replay),
                robot("r4", 300, 0));

        assertThat(written)
                .extracting(TopicRecord::topic, record -> new String(record.key(), UTF_8))
                .containsExactly(tuple(replay + ".collision", "r2-r3"), tuple(replay + ".collision", "r2-r3"));
    }

    @Test
    void refusesRulesThatCannotBeKept() {
        assertThatThrownBy(() -> options("--threshold", "0").rules())
                .isInstanceOf(ParameterException.class)
                .hasMessage("the threshold must be 0.1 to 100000 meters, not 0.0");
        assertThatThrownBy(() -> options("--cell", "1").rules())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("the cell must be at least as high as the threshold");
        assertThatThrownBy(() -> options("--zones", "/nowhere/yard.geojson").rules())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--zones /nowhere/yard.geojson: cannot be read");
        assertThat(options().rules()).isEqualTo(CollisionRules.DEFAULT);
    }
}
