package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.AutoClose;
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

    @AutoClose
    private final StubServer control = new StubServer(exchange -> {
        String body = new String(exchange.getRequestBody().readAllBytes(), UTF_8);
        requested.add((exchange.getRequestMethod() + " " + exchange.getRequestURI() + " " + body).trim());
        StubServer.answer(exchange, status, answer);
    });

    @ParameterizedTest
    @CsvSource({"'', ''", "--dry-run, ?dryRun=true"})
    void purgesAStoredMission(String option, String query) {
        answer = "{\"type\":\"response\",\"status\":\"purged\",\"mission\":\"m\",\"events\":4,\"markers\":1}";

        assertThat(option.isEmpty() ? run("mission", "purge", "m") : run("mission", "purge", "m", option))
                .isZero();

        assertThat(output.toString()).contains("purged", "mission m", "events 4");
        assertThat(requested).containsExactly("DELETE /api/recordings/m" + query);
    }

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
        assertThat(requested).containsExactly("GET /api/missions");
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

    private int run(String... arguments) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        List<String> all = new ArrayList<>(List.of(arguments));
        all.add("--api=" + control.uri(""));
        return line.execute(all.toArray(String[]::new));
    }
}
