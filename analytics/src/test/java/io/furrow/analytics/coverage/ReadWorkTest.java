package io.furrow.analytics.coverage;

import java.time.Duration;
import java.util.List;

import org.apache.flink.streaming.api.operators.ProcessOperator;
import org.apache.flink.streaming.util.OneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class ReadWorkTest {
    private static final long HOUR = Duration.ofHours(1).toMillis();

    /** A number, a text, a ROS message, in each unit; what is no width is not taken. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            {"value":2.5}                                             | 2.5
            {"value":"2.5"}                                           | 2.5
            {"value":"{%27data%27: 2.5}"}                             | 2.5
            {"value":60,"metadata":{"unitCode":{"value":"CMT"}}}      | 0.6
            {"value":250,"metadata":{"unit":{"value":"cm"}}}          | 2.5
            {"value":10,"metadata":{"unitCode":{"value":"FOT"}}}      | 3.048
            {"value":100}                                             | 100
            {"value":2.5,"metadata":{"unitCode":{"value":"KGM"}}}     | NaN
            {"value":101}                                             | NaN
            {"value":0}                                               | NaN
            {"value":-2}                                              | NaN
            {"value":"wide"}                                          | NaN
            """)
    void readsTheWorkingWidthInItsUnit(String attribute, double width) throws Exception {
        Reading reading = new Reading();
        reading.read(
                "data.raw",
                1000,
                "{\"id\":\"r1\",\"type\":\"Robot\",\"Latitude\":{\"value\":1},"
                        + "\"Longitude\":{\"value\":2},\"workingWidth\":" + attribute + "}");

        assertThat(reading.reports())
                .singleElement()
                .satisfies(report -> assertThat(report.width()).isEqualTo(width, within(1e-9)));
        reading.close();
    }

    @Test
    void readsTheAttributesOfTheOptions() throws Exception {
        Reading reading =
                new Reading("--width-attribute", "boom", "--work-attribute", "mode", "--work-values", "Spray,mow");
        for (String mode : List.of("SPRAY", "working")) {
            reading.read("data.raw", 1000, """
                    {"id":"r1","type":"Robot","boom":{"value":24},"workingWidth":{"value":2},"mode":{"value":"%s"}}""".formatted(mode));
        }

        assertThat(reading.reports()).extracting(WorkReport::width).containsExactly(24.0, 24.0);
        assertThat(reading.reports()).extracting(WorkReport::work).containsExactly(Work.ON, Work.OFF);
        assertThat(reading.reports()).extracting(WorkReport::isLocated).containsOnly(false);
        reading.close();
    }

    /** Ingest writes the dead letters of {@code data.raw}. */
    @Test
    void setsAsideAReportFromTheFuture() throws Exception {
        Reading reading = new Reading();
        String robot = """
                {"id":"r1","type":"Robot","Latitude":{"value":1},"Longitude":{"value":2},"workingWidth":{"value":2}}""";
        reading.read("data.raw", 1000 + HOUR, robot);
        reading.read("data.raw", 1001 + HOUR, robot);
        reading.read("reports", 1001 + HOUR, robot);

        assertThat(reading.reports()).extracting(WorkReport::time).containsExactly(1000 + HOUR);
        assertThat(reading.dead())
                .singleElement()
                .satisfies(letter -> assertThat(letter.headers())
                        .containsEntry(DeadLetter.REASON, "from-the-future")
                        .containsEntry(DeadLetter.STAGE, "coverage"));
        reading.close();
    }

    /** Reads entities that were received at 1000. */
    private static final class Reading {
        private final OneInputStreamOperatorTestHarness<TopicRecord, WorkReport> harness;

        Reading(String... args) throws Exception {
            CoverageOptions options = CoverageRun.options(args);
            harness = new OneInputStreamOperatorTestHarness<>(
                    new ProcessOperator<>(new ReadWork(options.attributes(), ClockSkewLimit.of(options))));
            harness.open();
        }

        void read(String topic, long time, String entity) throws Exception {
            TopicRecord record = CoverageRun.record("r1", time, entity).to(topic);
            harness.processElement(record.with(HeaderNames.TS_SOURCE, "1000"), time);
        }

        List<WorkReport> reports() {
            return harness.extractOutputValues();
        }

        List<TopicRecord> dead() {
            return harness.getSideOutput(DeadLetters.TAG).stream()
                    .map(letter -> letter.getValue())
                    .toList();
        }

        void close() throws Exception {
            harness.close();
        }
    }
}
