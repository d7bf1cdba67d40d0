package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.condition.EnabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** What the commands send to a control plane. */
class ReplayCommandGroupTest {
    private final StringWriter output = new StringWriter();
    private final List<String> requested = new ArrayList<>();
    private String answer = "{\"status\":\"created\",\"replay\":\"m.0a1b2c3d\",\"topic\":\"data.m.replay.0a1b2c3d\"}";

    @AutoClose
    private final StubServer control = new StubServer(exchange -> {
        String body = new String(exchange.getRequestBody().readAllBytes(), UTF_8);
        requested.add((exchange.getRequestMethod() + " " + exchange.getRequestURI() + " " + body).trim());
        StubServer.answer(exchange, 200, answer);
    });

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            stop m.0a1b2c3d                   | DELETE /api/replays/m.0a1b2c3d
            stop --group 0a1b2c3d             | DELETE /api/replays/groups/0a1b2c3d
            pause m.0a1b2c3d                  | POST /api/replays/m.0a1b2c3d/pause {}
            resume --group 0a1b2c3d           | POST /api/replays/groups/0a1b2c3d/resume {}
            seek m.0a1b2c3d 1777600000000     | POST /api/replays/m.0a1b2c3d/seek {"to":1777600000000}
            seek --group 0a1b2c3d 2026-05-01T00:00:00Z | POST /api/replays/groups/0a1b2c3d/seek {"to":1777593600000}
            speed m.0a1b2c3d 2                | POST /api/replays/m.0a1b2c3d/speed {"speed":2.0}
            speed --group 0a1b2c3d max        | POST /api/replays/groups/0a1b2c3d/speed {"speed":"max"}
            step m.0a1b2c3d                   | POST /api/replays/m.0a1b2c3d/step {"count":1}
            step m.0a1b2c3d -3                | POST /api/replays/m.0a1b2c3d/step {"count":-3}
            step --group 0a1b2c3d -3          | POST /api/replays/groups/0a1b2c3d/step {"count":-3}
            loop m.0a1b2c3d --off             | POST /api/replays/m.0a1b2c3d/loop {}
            show m.0a1b2c3d                   | GET /api/replays/m.0a1b2c3d
            missions                          | GET /api/recordings?limit=1000
            """)
    void steersAReplayOrAGroup(String arguments, String request) {
        assertThat(run(("replay " + arguments).split(" ")))
                .as(output.toString())
                .isZero();

        assertThat(requested).containsExactly(request);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            running | "state":"running"          | running
            running | "state":"ended"            | ended
            paused  | "state":"running"          | running, paused is requested
            stopped | "state":"paused"           | paused, stopped is requested
            running | "state":"failed"           | failed
            running |                            | not begun
            paused  |                            | not begun, paused is requested
            """)
    void listsWhatAReplayDoesAndWhatElseIsRequested(String desired, String status, String shown) {
        answer = "{\"replays\":[{\"replay\":\"m.0a1b2c3d\",\"wanted\":\"%s\",\"status\":{%s}}]}"
                .formatted(desired, status == null ? "" : status);

        run("replay", "list");

        assertThat(output.toString()).containsPattern("m\\.0a1b2c3d  -      " + shown + " +-");
    }

    @Test
    void reportsThatItStopped() {
        answer = "{\"type\":\"response\",\"status\":\"deleted\",\"replay\":\"m.0a1b2c3d\"}";

        run("replay", "stop", "m.0a1b2c3d");

        assertThat(output.toString()).isEqualToIgnoringNewLines("stopped: replay m.0a1b2c3d");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            seek m.0a1b2c3d 1777600000000 | paused: replay m.0a1b2c3d, to 2026-05-01T01:46:40Z
            speed m.0a1b2c3d 2            | paused: replay m.0a1b2c3d, speed 2.0
            pause m.0a1b2c3d              | paused: replay m.0a1b2c3d
            """)
    void reportsWhatWasChanged(String arguments, String sentence) {
        answer = "{\"type\":\"response\",\"status\":\"paused\",\"replay\":\"m.0a1b2c3d\"}";

        run(("replay " + arguments).split(" "));

        assertThat(output.toString()).isEqualToIgnoringNewLines(sentence);
    }

    @Test
    void loopsBetweenTwoTimes() {
        run("replay", "loop", "m.0a1b2c3d", "2026-05-01T00:00:00Z", "1777600000000");

        assertThat(requested)
                .singleElement()
                .asString()
                .contains("/loop {", "{\"from\":1777593600000,\"to\":1777600000000}");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            pause                     | Name a replay
            pause m.0a1b2c3d now      | comes nothing; there is 'now'
            seek m.0a1b2c3d           | comes TIME
            step m.0a1b2c3d -x        | '-x' is not a number of events
            step --nothing            | Name a replay
            loop m.0a1b2c3d 5         | comes A B
            seek m.0a1b2c3d soon      | 'soon' is not a time
            start m --from soon       | Invalid value for option '--from': 'soon' is not a time
            start                     | Name a mission
            start m --range 1         | is not A..B
            start m --source-topic data.t --source-file f | one of --source-topic and --source-file
            """)
    void rejectsWordsThatDoNotFit(String arguments, String why) {
        assertThat(run(("replay " + arguments).split(" "))).isEqualTo(2);

        assertThat(output.toString()).contains(why);
        assertThat(requested).isEmpty();
    }

    @Test
    void requestsAllThatAReplayCanBe() {
        run(
                ("replay start m --topic data.m.replay.0a1b2c3d --from 5 --to 2026-05-01T00:00:00Z --speed max --loop --device a --devices b --max-gap 30s "
                                + "--stamps now --at 7 --analytics collision,presence --source-file f.jsonl")
                        .split(" "));

        assertThat(requested)
                .containsExactly(
                        "POST /api/replays {\"mission\":\"m\",\"topic\":\"data.m.replay.0a1b2c3d\",\"from\":5,"
                                + "\"to\":1777593600000,\"speed\":\"max\",\"loop\":true,\"devices\":[\"a\",\"b\"],\"maxGap\":\"PT30S\","
                                + "\"stamps\":\"now\",\"startAt\":7,\"analytics\":[\"collision\",\"presence\"],\"source\":{\"file\":\"f.jsonl\"}}");
        assertThat(output.toString())
                .contains(
                        "flink run -d furrow-analytics-*-job.jar collision --name collision-of-m.0a1b2c3d --input data.m.replay.0a1b2c3d");
    }

    @Test
    void printsLinesForTheKafkaOfTheCluster() {
        run("replay", "start", "m", "--analytics", "collision", "--kafka", "kafka:9092");

        assertThat(requested).containsExactly("POST /api/replays {\"mission\":\"m\",\"analytics\":[\"collision\"]}");
        assertThat(output.toString())
                .contains("--input data.m.replay.0a1b2c3d --kafka kafka:9092")
                .doesNotContain("127.0.0.1:9092");
    }

    @Test
    void requestsAGroup() {
        answer = "{\"status\":\"created\",\"group\":\"0a1b2c3d\",\"replays\":[\"m.0a1b2c3d\",\"n.0a1b2c3d\"]}";

        run("replay", "start", "--mission", "m", "--mission", "n", "--analytics", "collision", "--range", "1..2");

        assertThat(requested)
                .singleElement()
                .asString()
                .startsWith("POST /api/replays {\"missions\":[\"m\",\"n\"],\"range\":{")
                .contains("\"from\":1", "\"to\":2");
        assertThat(output.toString())
                .contains(
                        "created: group 0a1b2c3d", "--input data.m.replay.0a1b2c3d", "--input data.n.replay.0a1b2c3d");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            list m                | GET /api/missions/m/markers?limit=1000
            add m 5 hail          | POST /api/missions/m/markers {"time":5,"note":"hail"}
            remove m a1           | DELETE /api/missions/m/markers/a1
            """)
    void storesMarkersOfAMission(String arguments, String request) {
        assertThat(run(("mission marker " + arguments).split(" ")))
                .as(output.toString())
                .isZero();

        assertThat(requested).containsExactly(request);
    }

    @Test
    void marksWhatHappenedSomeTimeAgo() {
        long before = System.currentTimeMillis();

        run("mission", "marker", "add", "m", "-5m", "hail");

        assertThat(requested).singleElement().satisfies(request -> {
            assertThat(request).matches("POST /api/missions/m/markers \\{\"time\":\\d+,\"note\":\"hail\"}");
            assertThat(Long.parseLong(request.replaceAll(".*:(\\d+),.*", "$1")))
                    .isBetween(before - 300_000, System.currentTimeMillis() - 300_000);
        });
    }

    @Test
    @EnabledOnOs(OS.LINUX)
    void saysThatATemplateCouldNotBeWritten() {
        answer = "{\"template\":\"t\",\"version\":1}";

        assertThat(run("template", "export", "t", "/dev/full")).isEqualTo(1);

        assertThat(run("template", "export", "t", "/nowhere/t.json")).isEqualTo(1);

        assertThat(output.toString())
                .contains(
                        "cannot read or write",
                        "/nowhere/t.json cannot be read or written: there is no such file or folder")
                .doesNotContain("exported");
    }

    private int run(String... arguments) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        List<String> all = new ArrayList<>(List.of(arguments));
        all.add("--api=" + control.uri(""));
        return line.execute(all.toArray(String[]::new));
    }
}
