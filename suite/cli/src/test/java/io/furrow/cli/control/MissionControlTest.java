package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** What the commands of missions send to a control plane, and what they print of its answers. */
class MissionControlTest {
    private final StringWriter output = new StringWriter();
    private final List<String> requested = new ArrayList<>();
    private int status = 200;
    private String answer = "{}";
    private String link;

    @AutoClose
    private final StubServer control = new StubServer(exchange -> {
        String body = new String(exchange.getRequestBody().readAllBytes(), UTF_8);
        requested.add((exchange.getRequestMethod() + " " + exchange.getRequestURI() + " " + body).trim());
        if (link != null) {
            exchange.getResponseHeaders().add("Link", link);
        }
        StubServer.answer(exchange, status, answer);
    });

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            created  | -
            starting | 2
            running  | 2
            stopping | -
            stopped  | -
            """)
    void listsHowManyDevicesAreUpWhileAMissionRuns(String state, String up) {
        answer = "{\"missions\":[{\"mission\":\"m\",\"domain\":\"d\",\"deviceCount\":5,\"status\":"
                + "{\"state\":\"%s\",\"devices\":2,\"confirmed\":2}}]}".formatted(state);

        assertThat(run("mission", "list")).isZero();

        assertThat(output.toString()).containsPattern("m +d +- +%s +%s +5 +-".formatted(state, up));
        assertThat(requested).containsExactly("GET /api/missions?limit=1000");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
            created | "due":1795755600000                       | starts 2026-11-27T05:00:00Z
            running | "due":1795755600000,"ends":1795755700000  | ends 2026-11-27T05:01:40Z
            created | "due":null                                | -
            running | "since":1795755600000                     | -
            """)
    void listsWhenAMissionStartsOrEnds(String state, String times, String next) {
        answer = "{\"missions\":[{\"mission\":\"m\",\"status\":{\"state\":\"%s\",%s}}]}".formatted(state, times);

        run("mission", "list");

        assertThat(output.toString()).contains("SINCE", "NEXT");
        assertThat(output.toString().contains(next == null ? "s 2026" : next)).isEqualTo(next != null);
    }

    @Test
    void sendsTimesAndDurationsAsPeopleWriteThem() {
        run("mission", "start", "m", "--at", "2026-05-01T06:00:00+02:00", "--duration", "1h30m");
        run("alarm", "mute", "a", "--for", "8h");
        run("alarm", "mute", "a");
        run("dead-letters", "list", "--from", "1777600000000", "--to", "2026-05-02");

        assertThat(requested)
                .containsExactly(
                        "POST /api/missions/m/start {\"mission\":\"m\",\"start\":1777608000000,\"duration\":\"PT1H30M\"}",
                        "POST /api/alarms/a/mute {\"for\":\"PT8H\"}",
                        "POST /api/alarms/a/mute {\"for\":\"PT1H\"}",
                        "GET /api/dead-letters?limit=50&from=2026-05-01T01%3A46%3A40Z&to=2026-05-02T00%3A00%3A00Z");
    }

    @Test
    void printsTimesOfAnswersForPeople() {
        answer =
                "{\"type\":\"response\",\"status\":\"scheduled\",\"mission\":\"m\",\"mission_topic\":\"data.d.realtime.m\",\"start\":1795755600000}";
        run("mission", "start", "m");
        assertThat(output.toString())
                .isEqualToIgnoringNewLines(
                        "scheduled: mission m, mission topic data.d.realtime.m, start 2026-11-27T05:00:00Z");

        output.getBuffer().setLength(0);
        answer =
                "{\"domain\":\"d\",\"created\":1795755600000,\"sequence\":7,\"area\":{\"type\":\"Point\",\"coordinates\":[1,2]}}";
        run("domain", "show", "d");
        assertThat(output.toString().lines())
                .containsExactly(
                        "domain            d",
                        "created           2026-11-27T05:00:00Z",
                        "sequence          7",
                        "area.type         Point",
                        "area.coordinates  [1,2]");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            a new mission needs a member 'domain'       | a new mission needs --domain (code)
            'duration' must be such as PT1H             | --duration must be such as PT1H (code)
            'template' must be 'a' or 'b'               | --template must be 'a' or 'b' (code)
            the request needs a member 'count'          | the request needs a member 'count' (code)
            there is no domain 'domain'                 | there is no domain 'domain' (code)
            """)
    void namesOptionsWhereTheControlPlaneNamesMembers(String reason, String sentence) {
        status = 400;
        answer = "{\"error\":\"code\",\"reason\":\"%s\"}".formatted(reason);

        assertThat(run("mission", "start", "m")).isEqualTo(1);

        assertThat(output.toString()).isEqualToIgnoringNewLines(sentence);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            mission list -o name            | m
            mission show m -o name          | m
            device credentials --mission m -o name | m
            mission list -o yaml            | - mission: "m"\\n  domain: "d"\\n  status:\\n    state: "created"
            mission list --output json      | [ {\\n  "mission" : "m",\\n  "domain" : "d",\\n  "status" : {\\n    "state" : "created"\\n  }\\n} ]
            """)
    void printsListsForPrograms(String arguments, String printed) {
        String mission = "{\"mission\":\"m\",\"domain\":\"d\",\"status\":{\"state\":\"created\"}}";
        answer = arguments.contains("list") || arguments.contains("--mission") ? "[" + mission + "]" : mission;

        assertThat(run(arguments.split(" "))).isZero();

        assertThat(output.toString().strip()).isEqualTo(printed.replace("\\n", "\n"));
        assertThat(requested)
                .as("times in ISO 8601 for programs")
                .allMatch(request -> request.contains("/api/v1/") == arguments.matches(".* (yaml|json)"));
    }

    @Test
    void printsRefusalsForProgramsToo() {
        status = 409;
        answer = "{\"error\":\"mission-exists\",\"reason\":\"there is one\"}";

        assertThat(run("mission", "create", "m", "--domain", "d", "-o", "yaml")).isEqualTo(1);

        assertThat(output.toString().strip()).isEqualTo("error: \"mission-exists\"\nreason: \"there is one\"");
        assertThat(run("mission", "list", "-o", "csv")).isEqualTo(2);
    }

    /** Where a request has read much and found nothing. */
    @Test
    void doesNotSayThatThereAreNoDeadLettersBeforeTheEnd() {
        link = "<?before=1>; rel=\"next\"";
        answer = "[]";

        run("dead-letters", "list");
        assertThat(output.toString())
                .isEqualToIgnoringNewLines("There may be more; --limit, --since and --to show others.");
        assertThat(requested).hasSize(20);

        link = null;
        run("dead-letters", "list");
        assertThat(output.toString()).contains("There are no such dead letters.");
    }

    @Test
    void namesDeadLettersAsShowTakesThem() {
        answer = "[{\"topic\":\"data.raw.dead\",\"partition\":1,\"offset\":7,\"time\":0,\"message\":\"%s\"}]"
                .formatted("x".repeat(90));

        run("dead-letters", "list", "-o", "name");
        run("dead-letters", "list");

        assertThat(output.toString()).startsWith("data.raw.dead-1@7").contains("  " + "x".repeat(90));
    }

    private int run(String... arguments) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        List<String> all = new ArrayList<>(List.of(arguments));
        all.add("--api=" + control.uri(""));
        return line.execute(all.toArray(String[]::new));
    }
}
