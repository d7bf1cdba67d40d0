package io.furrow.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.List;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.launcher.Furrow;
import io.furrow.launcher.command.DemoFarm;
import io.furrow.launcher.suite.Suite;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;
import io.furrow.process.TestProcess;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The commands of docs/week.md as they stand there, on the demonstration farm: first those of ./furrow, then those of curl. */
@Tag("full")
class WeekIT {
    private static final Path PAGE = Path.of("..", "docs", "week.md");
    private static final Path PARCELS =
            Path.of("..", "control-plane", "fields", "src", "test", "resources", "io", "furrow", "fields");
    private static final Pattern TASK = Pattern.compile("(?ms)^## (.*?)$(.*?)(?=^## |\\z)");
    private static final Pattern COMMANDS = Pattern.compile("(?ms)^```\n(.*?)^```");
    /** The page shows the 18th record of a topic. */
    private static final int RECORDS = 18;

    @TempDir
    Path directory;

    /** A task of the page. */
    private record Task(String title, String terminal, String curl) {
        static Task of(MatchResult found) {
            List<String> blocks = COMMANDS.matcher(found.group(2))
                    .results()
                    .map(block -> block.group(1))
                    .toList();
            assertThat(blocks).as(found.group(1)).hasSize(2);
            assertThat(blocks.get(0)).contains("./furrow ").doesNotContain("curl ");
            assertThat(blocks.get(1)).contains("curl ").doesNotContain("./furrow ");
            return new Task(found.group(1), blocks.get(0), blocks.get(1));
        }
    }

    @Test
    void worksAsItStands() throws Exception {
        List<Task> tasks =
                TASK.matcher(Files.readString(PAGE)).results().map(Task::of).toList();
        assertThat(tasks).hasSize(11);
        try (RunningSuite running = RunningSuite.start(null)) {
            prepare(running);
            StringBuilder printed = new StringBuilder();
            for (Task task : tasks) {
                printed.append(run(running, task.title(), task.terminal()));
            }
            assertThat(printed)
                    .contains("Status: ", "is deleted", "stopped: mission weeding", "ENCOUNTERS")
                    .contains("18 dead letters from data.raw.dead to data.raw: 18 not-json")
                    .containsPattern("data.raw-[0-3]@[0-9]+ +\\S+ +urn:ngsi-ld:Thermometer:4 ");
            DemoFarm.start(running.suite().control()); // it was stopped
            running.awaitState("weeding", "running");
            for (Task task : tasks) {
                run(running, task.title(), task.curl());
            }
            assertThat(running.get("/api/missions").findValuesAsText("mission")).contains("harrowing", "mowing");
            assertThat(running.get("/api/fields").findValuesAsText("id"))
                    .contains("south-2")
                    .doesNotContain("north-1");
        }
    }

    private void prepare(RunningSuite running) throws Exception {
        running.awaitReady();
        DemoFarm.start(running.suite().control());
        for (String suffix : List.of("shp", "dbf", "prj", "cpg")) {
            Files.copy(PARCELS.resolve("shapefile-25830." + suffix), directory.resolve("parcels." + suffix));
        }
        Files.copy(PARCELS.resolve("geopackage-25830.gpkg"), directory.resolve("parcels.gpkg"));
        Files.writeString(directory.resolve("furrow"), script());
        Files.setPosixFilePermissions(directory.resolve("furrow"), PosixFilePermissions.fromString("rwxr-xr-x"));
        sendDeadLetters(running.suite());
        running.awaitState("weeding", "running");
        ReplayIT.awaitListed(running, "weeding");
        await().until(() -> running.request("GET", "/api/topics/data.raw/records/0/" + (RECORDS - 1), "")
                        .statusCode()
                == 200);
    }

    /** Differences are no failure of a comparison, which waits here for the analytics of its replay. */
    private String script() {
        String java = TestProcess.java(
                        "-Xmx512m -XX:+UseSerialGC -XX:TieredStopAtLevel=1 -Duser.home=" + directory, Furrow.class)
                .command()
                .stream()
                .map(word -> "'" + word + "'")
                .collect(Collectors.joining(" "));
        return """
                #!/bin/bash
                for try in {1..20}; do
                    %s "$@"
                    code=$?
                    [[ "$1 $2" == "replay compare" ]] || exit $code
                    [[ $code == 2 ]] || exit 0
                done
                exit $code
                """.formatted(java);
    }

    private static void sendDeadLetters(Suite suite) throws Exception {
        try (KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                suite.kafka().clientProperties(), new StringSerializer(), new ByteArraySerializer())) {
            for (int i = 0; i < RECORDS; i++) {
                ProducerRecord<String, byte[]> letter =
                        new ProducerRecord<>(Topics.dead(Topics.RAW), 0, "robot", "{\"id\":".getBytes(UTF_8));
                new DeadLetter(Reason.NOT_JSON, "no JSON", "ingest", Topics.RAW + "-0@" + i)
                        .headers()
                        .forEach((name, text) -> letter.headers().add(name, text.getBytes(UTF_8)));
                producer.send(letter).get();
            }
        }
    }

    /** Runs commands in a shell that ends with the first that fails. */
    private String run(RunningSuite running, String title, String commands) throws IOException, InterruptedException {
        String begin = """
                set -eux -o pipefail
                api=%sapi/v1
                curl() { command curl --fail-with-body -S "$@"; }
                """.formatted(running.suite().control().resolve("/"));
        ProcessBuilder shell = new ProcessBuilder("bash", "-c", begin + commands);
        Suite suite = running.suite();
        shell.environment().put("FURROW_API", suite.control().toString());
        TestProcess.Ended ended = TestProcess.run(shell.directory(directory.toFile()));
        assertThat(ended.status()).as(title + "\n" + ended.output()).isZero();
        return ended.output();
    }
}
