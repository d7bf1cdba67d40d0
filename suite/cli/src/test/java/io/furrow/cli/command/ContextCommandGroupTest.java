package io.furrow.cli.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CopyOnWriteArrayList;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.cli.option.Contexts;
import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;

class ContextCommandGroupTest {
    private final List<String> tokens = new CopyOnWriteArrayList<>();
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @AutoClose
    private final StubServer server = new StubServer(exchange -> {
        tokens.add(String.valueOf(exchange.getRequestHeaders().getFirst("Authorization")));
        StubServer.answer(exchange, 200, "[{\"mission\":\"weeding\"}]");
    });

    @TempDir
    private Path folder;

    @Test
    void givesOptionsTheValuesOfTheContextInUse() throws IOException {
        write("farm", "api=%s\ntoken-file=farm.token\noutput=name\n".formatted(server.uri("")));
        Files.writeString(folder.resolve("farm.token"), "token-of-the-farm\n");
        write("barn", "api=http://127.0.0.1:1\n");

        assertThat(run(Map.of(), "context", "use", "farm")).isZero();
        out.getBuffer().setLength(0);
        assertThat(run(Map.of(), "mission", "list")).isZero();

        assertThat(out.toString()).isEqualToIgnoringNewLines("weeding");
        assertThat(tokens).containsExactly("Bearer token-of-the-farm");
        assertThat(run(Map.of(), "mission", "list", "-o", "json")).isZero();
        assertThat(out.toString()).contains("\"mission\"");
        assertThat(run(Map.of("FURROW_CONTEXT", "barn"), "mission", "list")).isNotZero();
        assertThat(err.toString()).contains("http://127.0.0.1:1");
    }

    @Test
    void sendsItsTokenToItsOwnApiOnly() throws IOException {
        String api = server.uri("").toString().replaceAll("/+$", "");
        Files.writeString(folder.resolve("farm.token"), "token-of-the-farm\n");
        Files.writeString(folder.resolve("other.token"), "other-token\n");
        write("farm", "api=%s\ntoken-file=farm.token\n".formatted(api));
        write("barn", "api=http://127.0.0.1:1\ntoken-file=farm.token\n");
        write("yard", "token-file=farm.token\n");

        Map<String, String> farm = Map.of("FURROW_CONTEXT", "farm");
        run(farm, "mission", "list", "--api", api + "/");
        assertThat(tokens).containsExactly("Bearer token-of-the-farm");
        tokens.clear();
        for (String other : List.of("barn", "yard")) {
            assertThat(run(Map.of("FURROW_CONTEXT", other), "mission", "list", "--api", api))
                    .isZero();
        }
        String file = folder.resolve("other.token").toString();
        run(Map.of("FURROW_CONTEXT", "barn"), "mission", "list", "--api", api, "--token-file", file);
        assertThat(tokens).containsExactly("null", "null", "Bearer other-token");
    }

    @Test
    void prefersVariables() throws IOException {
        Contexts contexts = contexts(Map.of("FURROW_API", "x", "FURROW_TOKEN", "x"));
        write("farm", "api=http://127.0.0.1:1\nmongo=mongodb://a\ntoken-file=nosuch\n");
        contexts.use("farm");

        CommandLine list = furrow(contexts).getSubcommands().get("catalog");
        assertThat(contexts.defaultValue(list.getCommandSpec().findOption("--mongo")))
                .isEqualTo("mongodb://a");
        CommandLine audit = furrow(contexts).getSubcommands().get("audit");
        assertThat(contexts.defaultValue(audit.getCommandSpec().findOption("--api")))
                .isNull();
        assertThat(contexts.defaultValue(audit.getCommandSpec().findOption("--token-file")))
                .isNull();
    }

    @Test
    void listsShowsAndLeavesContexts() throws IOException {
        run(Map.of(), "context", "list");
        assertThat(out.toString()).startsWith("There are no contexts; a file ~/.config/furrow/NAME.properties");
        write("farm", "mongo=mongodb://a\n");
        write("barn", "");
        out.getBuffer().setLength(0);

        run(Map.of(), "context", "use", "farm");
        run(Map.of(), "context", "list");
        run(Map.of(), "context", "show");
        run(Map.of(), "context", "use");

        assertThat(out.toString().lines())
                .containsExactly(
                        "context farm",
                        "mongo=mongodb://a",
                        "  barn",
                        "* farm",
                        "context farm",
                        "mongo=mongodb://a",
                        "No context is in use.");
    }

    @ParameterizedTest
    @CsvSource({"nosuch, There is no context nosuch; write", "wrong, has the unknown key 'apy'; a context may have api"
    })
    void rejectsWhatIsNoContext(String name, String reason) throws IOException {
        write("wrong", "apy=x\n");

        assertThat(run(Map.of("FURROW_CONTEXT", name), "mission", "list")).isEqualTo(2);
        assertThat(run(Map.of(), "context", "use", name)).isEqualTo(1);

        assertThat(err.toString().lines())
                .filteredOn(line -> line.contains(reason))
                .hasSize(2);
    }

    @Test
    void isReadForNoHelp() {
        CommandLine audit = Commands.commandLine(CommandSpec.create(), Commands.ALL, "--help")
                .getSubcommands()
                .get("audit");

        assertThat(audit.getDefaultValueProvider()).isNull();
        assertThat(furrow(contexts(Map.of())).getSubcommands().get("audit").getDefaultValueProvider())
                .isNotNull();
    }

    private void write(String name, String content) throws IOException {
        Files.writeString(folder.resolve(name + ".properties"), content);
    }

    private Contexts contexts(Map<String, String> environment) {
        return new Contexts(folder, environment);
    }

    private int run(Map<String, String> environment, String... arguments) {
        return furrow(contexts(environment)).execute(arguments);
    }

    private CommandLine furrow(Contexts contexts) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        line.getCommandSpec().removeSubcommand("context");
        line.addSubcommand(new CommandLine(new ContextCommandGroup(contexts)));
        line.getSubcommands().values().forEach(command -> command.setDefaultValueProvider(contexts));
        return line.setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));
    }
}
