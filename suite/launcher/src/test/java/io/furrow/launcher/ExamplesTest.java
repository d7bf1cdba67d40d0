package io.furrow.launcher;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import picocli.CommandLine;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.ParseResult;

import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;

/** Commands in the help and on the pages are such as the command line takes. */
class ExamplesTest {
    private static final Path HOME = Path.of("..", "..");
    private static final Pattern BLOCK = Pattern.compile("(?ms)^```\\w*\n(.*?)^```");
    private static final Pattern WORD = Pattern.compile("\"([^\"]*)\"|'([^']*)'|(\\S+)");

    private final CommandLine furrow = Furrow.commandLine();

    @Test
    void showsAnExampleInTheHelpOfEachCommand() {
        assertThat(commands(furrow)).hasSizeGreaterThan(80).allSatisfy(command -> {
            List<String> examples = HelpExamples.of(command.getCommandSpec());
            assertThat(examples).as(command.getCommandSpec().qualifiedName()).isNotEmpty();
            assertThat(command.getUsageMessage()).contains("Example: " + examples.get(0));
            for (String example : examples) {
                ParseResult parsed = furrow.parseArgs(words(example));
                while (parsed.hasSubcommand()) {
                    parsed = parsed.subcommand();
                }
                assertThat(parsed.commandSpec().commandLine()).as(example).isSameAs(command);
            }
        });
    }

    @Test
    void takesTheCommandsOfThePages() throws IOException {
        List<Path> pages = new ArrayList<>(List.of(HOME.resolve("README.md")));
        for (String part : List.of("docs", "control-plane", "dashboard", "ingest", "kit", "simulators")) {
            Folders.walk(HOME.resolve(part)).stream()
                    .filter(file -> file.toString().matches("(?!.*/(adr|target|node_modules)/).*\\.md"))
                    .forEach(pages::add);
        }
        List<String> refused = new ArrayList<>();
        int commands = 0;
        for (Path page : pages) {
            for (String command : commandsOf(Files.readString(page))) {
                commands++;
                try {
                    furrow.parseArgs(words(command));
                } catch (ParameterException e) {
                    refused.add("%s: %s: %s".formatted(page, command, e.getMessage()));
                }
            }
        }
        assertThat(refused).isEmpty();
        assertThat(commands).isGreaterThan(60);
    }

    private static List<CommandLine> commands(CommandLine command) {
        return command.getSubcommands().isEmpty()
                ? List.of(command)
                : command.getSubcommands().values().stream()
                        .flatMap(each -> commands(each).stream())
                        .toList();
    }

    /** Without comments; those of other programs, and with a place for what the reader has, are left out. */
    private static List<String> commandsOf(String page) {
        return BLOCK.matcher(page)
                .results()
                .flatMap(block -> block.group(1).replaceAll("\\\\\n\\s*", "").lines())
                .map(line -> line.replaceFirst(" +[#>] .*", "").strip())
                .filter(line -> line.matches("\\./furrow (?!bench|soak).*") && !line.matches(".*([…<|]|\\$s3).*"))
                .map(line -> line.replaceAll("\\$\\w+", "now"))
                .toList();
    }

    private static String[] words(String command) {
        return WORD.matcher(command)
                .results()
                .skip(1)
                .map(word -> Stream.of(1, 2, 3).map(word::group).filter(text -> text != null))
                .map(texts -> texts.findFirst().orElseThrow())
                .toArray(String[]::new);
    }
}
