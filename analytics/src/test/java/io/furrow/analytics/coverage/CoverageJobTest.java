package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.Base64;
import java.util.List;
import java.util.Map;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine.ParameterException;

import io.furrow.analytics.Replayed;
import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.FieldRecords;
import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static io.furrow.analytics.coverage.CoverageRun.entity;
import static io.furrow.analytics.coverage.CoverageRun.options;
import static io.furrow.analytics.coverage.CoverageRun.record;
import static io.furrow.analytics.coverage.CoverageRun.report;
import static io.furrow.analytics.coverage.CoverageRun.run;
import static io.furrow.analytics.coverage.Drives.fix;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;
import static org.assertj.core.api.Assertions.within;

class CoverageJobTest {
    private static final Logger LOG = LoggerFactory.getLogger(CoverageJobTest.class);

    static final InMemoryReporter METRICS = InMemoryReporter.create();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(4, METRICS.addToConfiguration(new Configuration()));

    /** 40 by 40 meters. */
    private static final List<TopicRecord> SQUARE = square();

    private static List<TopicRecord> square() {
        FieldRecords fields = new FieldRecords();
        fields.area("f", 0, "farm", Drives.square(40));
        return fields.all();
    }

    /** In any order of arrival, at any parallelism: at each instant what the definition says. */
    @ParameterizedTest
    @ValueSource(ints = {1, 2, 4})
    void reportsTheSameAsTheDefinition(int parallelism) throws Exception {
        long seed = Long.getLong("coverage.seed", System.nanoTime());
        LOG.info("drives as a job from seed {}", seed);
        for (int index = 0; index < 3; index++) {
            Drives drives = new Drives(seed + index);
            CoverageOptions options =
                    options("--cell", "1", "--every", "30s", "--parallelism", Integer.toString(parallelism));

            List<TopicRecord> written = run(
                    options,
                    drives.fields.all(),
                    drives.arrivals().stream().map(CoverageRun::report).toArray(TopicRecord[]::new));

            assertThat(written).extracting(TopicRecord::topic).containsOnly("data.coverage", "data.coverage.layer");
            assertThat(written.stream()
                            .filter(record -> record.topic().equals("data.coverage"))
                            .map(CoverageRun::line)
                            .sorted())
                    .as("drives %d of seed %d", index, seed)
                    .containsExactlyElementsOf(CoverageRun.expected(drives, options));
        }
    }

    /** Two rows of ten meters, three meters apart, two meters wide: 40 m² and a gap of 10 m². */
    private static TopicRecord[] twoRows() {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second <= 10; second++) {
            double way = second;
            records.add(report(work("r1", 10 + way, 10, second, 2, Work.UNKNOWN)));
            records.add(report(work("r2", 20 - way, 13, second, 2, Work.UNKNOWN)));
        }
        return records.toArray(TopicRecord[]::new);
    }

    private static WorkReport work(String robot, double east, double north, long second, double width, Work work) {
        return new WorkReport(fix(robot, "weeding", east, north, Drives.START + second * 1000), width, work);
    }

    @Test
    void writesEntitiesOfMissionFieldAndRobot() throws Exception {
        List<TopicRecord> written = run(options("--cell", "0.25", "--every", "20s"), SQUARE, twoRows());

        List<TopicRecord> figures = written.stream()
                .filter(record -> record.topic().equals("data.coverage"))
                .toList();
        assertThat(figures).hasSize(3);
        assertThat(figures).extracting(TopicRecord::key).doesNotHaveDuplicates();
        Entity all = figures.stream()
                .map(CoverageRun::entity)
                .filter(entity -> entity.text("device").isEmpty())
                .findAny()
                .orElseThrow();
        assertThat(all.type()).isEqualTo("Analytics:Coverage");
        assertThat(all.text("field")).contains("f");
        assertThat(all.text("Mission")).contains("weeding");
        assertThat(all.text("Domain")).contains("farm");
        assertThat(all.number("hectares").orElseThrow()).isCloseTo(0.004, within(0.0005));
        assertThat(all.number("gapHectares").orElseThrow()).isCloseTo(0.001, within(0.0003));
        assertThat(all.number("overlapHectares")).contains(0.0);
        assertThat(all.number("fieldHectares").orElseThrow()).isCloseTo(0.16, within(0.002));
        assertThat(all.number("share").orElseThrow()).isCloseTo(0.025, within(0.003));
        assertThat(all.number("startTime")).contains((double) Drives.START);
        assertThat(all.number("endTime")).contains(Drives.START + 10_000.0);
        assertThat(all.number("time")).contains(Drives.START + 20_000.0);
        double rate = all.number("hectaresPerHour").orElseThrow();
        assertThat(rate).isCloseTo(0.004 * 3600 / 20, within(0.1));
        assertThat(all.number("timeLeft").orElseThrow()).isCloseTo((0.16 - 0.004) / rate * 3_600_000, within(20_000.0));
        assertThat(figures)
                .allSatisfy(record -> {
                    assertThat(record.timestamp()).isEqualTo(Drives.START + 20_000);
                    assertThat(record.headers())
                            .containsAllEntriesOf(Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/"));
                })
                .filteredOn(record -> entity(record).text("device").isPresent())
                .allSatisfy(record -> {
                    Entity own = entity(record);
                    assertThat(own.text("deviceType")).contains("Robot");
                    assertThat(own.number("hectares").orElseThrow()).isCloseTo(0.002, within(0.0003));
                    assertThat(own.value("gapHectares")).isEmpty();
                });
    }

    @Test
    void writesTheCellsOfAllRobotsAsALayer() throws Exception {
        List<TopicRecord> written = run(options("--cell", "0.25", "--every", "20s"), SQUARE, twoRows());

        TopicRecord layer = written.stream()
                .filter(record -> record.topic().equals("data.coverage.layer"))
                .findAny()
                .orElseThrow();
        Entity entity = entity(layer);
        assertThat(entity.type()).isEqualTo("Analytics:CoverageLayer");
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.coverage"))
                .extracting(TopicRecord::key)
                .contains(layer.key());
        int columns = entity.number("columns").orElseThrow().intValue();
        int rows = entity.number("rows").orElseThrow().intValue();
        String cells = cells(Base64.getDecoder().decode(entity.text("runs").orElseThrow()));
        assertThat(cells).hasSize(columns * rows);
        assertThat(cells.charAt(42 * columns + 60)).as("in the lower row").isEqualTo('1');
        assertThat(cells.charAt(46 * columns + 60)).as("between both").isEqualTo('3');
        assertThat(cells.charAt(60 * columns + 60)).as("above").isEqualTo('0');
        double west = entity.value("box").orElseThrow().get(0).asDouble();
        double east = entity.value("box").orElseThrow().get(2).asDouble();
        assertThat(east - west).isCloseTo(columns * 0.25 / 84_800, within(1e-5));
    }

    private static String cells(byte[] runs) {
        StringBuilder cells = new StringBuilder();
        int number = 0;
        int shift = 0;
        for (byte each : runs) {
            number |= (each & 0x7f) << shift;
            shift += 7;
            if (each >= 0) {
                cells.append(Integer.toString(number & 3).repeat(number >> 2));
                number = 0;
                shift = 0;
            }
        }
        return cells.toString();
    }

    /** In each form in which a state is reported, and where none is. */
    @ParameterizedTest
    @CsvSource({
        "true, true",
        "false, false",
        "'\"On\"', true",
        "'\"off\"', false",
        "1, true",
        "0, false",
        "'\"{%27data%27: %27Working%27}\"', true",
        "'\"{%27data%27: false}\"', false",
        "null, true"
    })
    void countsOnlyWhatIsWorked(String state, boolean works) throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second < 5; second++) {
            TopicRecord plain = report(work("r", 10 + second, 10, second, 2, Work.UNKNOWN));
            String value = new String(plain.value(), UTF_8);
            String more = ",\"working\":{\"type\":\"Any\",\"value\":" + state + ",\"metadata\":{}}}";
            records.add(plain.withValue((value.substring(0, value.length() - 1) + more).getBytes(UTF_8)));
        }

        List<TopicRecord> written = run(options(), SQUARE, records.toArray(TopicRecord[]::new));
        assertThat(!written.isEmpty()).isEqualTo(works);
    }

    @Test
    void takesTheWidthFromTheOptionOnlyForRobots() throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second < 5; second++) {
            records.add(report(work("r", 10 + second, 10, second, Double.NaN, Work.UNKNOWN)));
        }
        TopicRecord[] all = records.toArray(TopicRecord[]::new);
        assertThat(run(options(), SQUARE, all)).isEmpty();
        assertThat(run(options("--working-width", "2", "--types", "Tractor"), SQUARE, all))
                .isEmpty();
        assertThat(run(options("--working-width", "2", "--types", "Tractor,Robot"), SQUARE, all))
                .isNotEmpty();
    }

    @Test
    void keepsAReplayToItselfAndItsResultsWithIt() throws Exception {
        String replay = "data.hoeing.replay.0a1b2c3d";
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second < 5; second++) {
            TopicRecord live = report(work("r", 10 + second, 10, second, 2, Work.UNKNOWN));
            records.add(live);
            records.add(live.to(replay));
        }
        records.add(report(work("r", 15, 10, 60, 2, Work.UNKNOWN)).to(replay));
        records.add(report(work("r", 15, 10, 30, 2, Work.UNKNOWN)).to(replay));

        assertThat(run(options("--parallelism", "1"), SQUARE, records.toArray(TopicRecord[]::new)))
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder(
                        "data.coverage",
                        "data.coverage",
                        "data.coverage.layer",
                        replay + ".coverage",
                        replay + ".coverage",
                        replay + ".coverage.layer",
                        replay + ".coverage.late");
    }

    @Tag("full")
    @Test
    void setsAsideWhatIsUnreadableOrLate() throws Exception {
        TopicRecord garbage = record("x", Drives.START, "{not json");
        List<TopicRecord> written = run(
                options("--parallelism", "1"),
                SQUARE,
                report(work("r", 10, 10, 0, 2, Work.UNKNOWN)),
                garbage.to("reports"),
                garbage, // of data.raw, which ingest sets aside
                record("r2", Drives.START, null),
                report(work("wide", 10, 10, 0, 1000, Work.UNKNOWN)),
                report(work("wide", 11, 10, 1, 1000, Work.UNKNOWN)),
                report(work("r", 15, 10, 60, 2, Work.UNKNOWN)),
                report(work("r", 15, 10, 30, 2, Work.UNKNOWN)));

        assertThat(written)
                .extracting(TopicRecord::topic, TopicRecord::timestamp)
                .containsExactlyInAnyOrder(
                        tuple("reports.dead", Drives.START), tuple("data.coverage.late", Drives.START + 30_000));
        assertThat(written.get(0).headers()).containsEntry(DeadLetter.STAGE, "coverage");
    }

    @Tag("full")
    @Test
    void reportsOfEachEpochOfAReplayWhatItReportsOfItAlone() throws Exception {
        Drives drives = new Drives(5); // in which robots work before and after the point
        CoverageOptions options = options(("--input %s --working-width 2 --cell 1 --every 30s --out-of-orderness %dms")
                .formatted(Replayed.TOPIC, Drives.BOUND)
                .split(" "));
        List<TopicRecord> arrivals =
                drives.arrivals().stream().map(CoverageRun::report).toList();

        Replayed.assertThatEpochsAreAsAlone(
                Replayed.epochs(arrivals, Drives.START + 50_000),
                records -> run(options, drives.fields.all(), records.toArray(TopicRecord[]::new)));
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            --working-width 0         | --working-width must be above 0, at most 100 m
            --min-speed 3 --max-speed 2 | --min-speed must be at least 0, and --max-speed greater
            --max-gap 1h              | --max-gap must be above 0, at most 10min
            --cell 0.01               | --cell must be between 0.05 and 100 m
            --every 10ms              | --every must be at least 1s
            --time-to-live 5s         | --time-to-live must be longer than --max-gap
            """)
    void refusesRulesThatCannotBeKept(String args, String message) {
        assertThatThrownBy(() -> options(args.split(" ")).rules())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining(message);
    }
}
