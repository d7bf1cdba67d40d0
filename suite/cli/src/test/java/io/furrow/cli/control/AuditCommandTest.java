package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;

class AuditCommandTest {
    private static final String ENTRIES = """
            [{"time":1795755600000,"user":"ann","target":"service.missionmanager","command":"stop","about":{"mission":"m"},"result":"stopped"},
             {"time":1795755500000,"user":"bob","target":"service.missionmanager","command":"start","about":{"mission":"m","start":1795755600000},
              "result":"error","reason":"it runs"}]""";

    private final StringWriter output = new StringWriter();
    private final List<String> requested = new CopyOnWriteArrayList<>();

    @AutoClose
    private final StubServer control = new StubServer(exchange -> {
        requested.add(exchange.getRequestURI().toString());
        exchange.getResponseHeaders().add("Link", "<?before=5>; rel=\"next\"");
        StubServer.answer(exchange, 200, ENTRIES);
    });

    @Test
    void listsWhoCommandedWhat() {
        assertThat(run("--mission", "m", "--limit", "2")).isZero();

        assertThat(requested).containsExactly("/api/audit?limit=2&mission=m");
        assertThat(output.toString().lines())
                .satisfiesExactly(
                        line -> assertThat(line).startsWith("TIME"),
                        line -> assertThat(line)
                                .matches(
                                        "2026-11-27T05:00:00Z +ann +service.missionmanager +stop +stopped +mission m +-"),
                        line -> assertThat(line)
                                .matches(".* bob .* start +error +mission m, start 2026-11-27T05:00:00Z +it runs"),
                        line -> assertThat(line).isEqualTo("There may be more; --limit reads more of them."));
    }

    @Test
    void listsThoseOfOneUserSinceATime() {
        run("--user", "ann", "--limit", "2", "--since", "2026-11-27T05:00:00Z");

        assertThat(output.toString()).contains("ann").doesNotContain("bob", "There may be more");
        output.getBuffer().setLength(0);
        run("--to", "2026-11-27T05:00:00Z");
        assertThat(output.toString()).contains("bob").doesNotContain("ann");
        assertThat(run("--limit", "0")).isEqualTo(2);
    }

    private int run(String... arguments) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        return line.execute(java.util.stream.Stream.concat(
                        java.util.stream.Stream.of("audit", "--api=" + control.uri("")),
                        java.util.stream.Stream.of(arguments))
                .toArray(String[]::new));
    }
}
