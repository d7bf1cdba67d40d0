package io.furrow.launcher;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

import picocli.CommandLine;
import picocli.CommandLine.IHelpSectionRenderer;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.UsageMessageSpec;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Ends the help of each command with its examples, the lines of {@code examples.txt} that begin with its name. */
final class HelpExamples {
    private static final String FILE = "examples.txt";

    private HelpExamples() {}

    /** Adds them to all commands of a root. */
    static void addTo(CommandLine root) {
        Map<String, IHelpSectionRenderer> sections = new HashMap<>(root.getHelpSectionMap());
        IHelpSectionRenderer footer = sections.get(UsageMessageSpec.SECTION_KEY_FOOTER);
        sections.put(UsageMessageSpec.SECTION_KEY_FOOTER, help -> footer.render(help) + footer(of(help.commandSpec())));
        root.setHelpSectionMap(sections);
    }

    private static String footer(List<String> examples) {
        return examples.stream()
                .map(example -> "%nExample: %s%n".formatted(example))
                .collect(Collectors.joining());
    }

    /** The examples of a command; none of one that has commands. */
    static List<String> of(CommandSpec command) {
        if (!command.subcommands().isEmpty()) {
            return List.of();
        }
        String name = "./" + command.qualifiedName();
        try (InputStream file = HelpExamples.class.getResourceAsStream(FILE)) {
            return new String(file.readAllBytes(), UTF_8)
                    .lines()
                    .filter(line -> line.equals(name) || line.startsWith(name + " "))
                    .toList();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
