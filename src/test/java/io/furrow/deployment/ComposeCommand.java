package io.furrow.deployment;

import java.io.IOException;
import java.nio.file.Path;

import com.fasterxml.jackson.databind.JsonNode;

/** Prints the command of a service of a compose file, one word per line, to run it without containers. */
public final class ComposeCommand {
    private ComposeCommand() {}

    /** Arguments: compose file, service, and {@code entrypoint}, {@code command} or {@code environment}. */
    public static void main(String... args) throws IOException {
        JsonNode part =
                ComposeFile.read(Path.of(args[0])).services().get(args[1]).path(args[2]);
        if (part.isMissingNode()) {
            throw new IllegalArgumentException(args[1] + " has no " + args[2]);
        }
        part.properties()
                .forEach(entry -> System.out.println(
                        entry.getKey() + "=" + entry.getValue().asText()));
        part.elements().forEachRemaining(argument -> {
            if (part.isArray()) {
                System.out.println(argument.asText());
            }
        });
    }
}
