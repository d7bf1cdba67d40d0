package io.furrow.deployment;

import java.io.IOException;
import java.io.Reader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Properties;
import java.util.regex.Matcher;

import com.fasterxml.jackson.databind.JsonNode;

/** Prints the command of a service of a compose file, one word per line, to run it without containers. */
public final class ComposeCommand {
    private ComposeCommand() {}

    /** Arguments: compose file, {@code .env} file, service, and {@code entrypoint}, {@code command} or {@code environment}. */
    public static void main(String... args) throws IOException {
        JsonNode part =
                ComposeFile.read(Path.of(args[0])).services().get(args[2]).path(args[3]);
        if (part.isMissingNode()) {
            throw new IllegalArgumentException(args[2] + " has no " + args[3]);
        }
        Properties variables = new Properties();
        try (Reader file = Files.newBufferedReader(Path.of(args[1]))) {
            variables.load(file);
        }
        part.properties()
                .forEach(entry -> print(entry.getKey() + "=" + entry.getValue().asText(), variables));
        part.elements().forEachRemaining(argument -> {
            if (part.isArray()) {
                print(argument.asText(), variables);
            }
        });
    }

    private static void print(String argument, Properties variables) {
        System.out.println(ComposeFile.VARIABLE
                .matcher(argument)
                .replaceAll(found -> Matcher.quoteReplacement(variables.getProperty(found.group(1)))));
    }
}
