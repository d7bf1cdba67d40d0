package io.furrow.containers;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * A third-party service of {@code docker/compose.yaml}, for tests that run its image in a container.
 *
 * @param image with its tag
 * @param environment its variables that are on lines of their own
 */
public record PinnedService(String image, Map<String, String> environment) {
    private static final Pattern VARIABLE = Pattern.compile("(?m)^ {6}([A-Z_]+): \"?([^\"\\n]*)\"?$");

    /** @throws IOException if the file cannot be read */
    public static PinnedService of(String name) throws IOException {
        String compose = Files.readString(Path.of("..", "docker", "compose.yaml"));
        Matcher service = Pattern.compile("(?ms)^ {2}%s:\\n {4}image: (\\S+)\\n(.*?)(?=^ {0,2}\\S)".formatted(name))
                .matcher(compose);
        assertThat(service.find()).as("service " + name).isTrue();
        Map<String, String> environment = new TreeMap<>();
        VARIABLE.matcher(service.group(2))
                .results()
                .forEach(variable -> environment.put(variable.group(1), variable.group(2)));
        return new PinnedService(service.group(1), environment);
    }
}
