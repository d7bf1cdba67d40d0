package io.furrow.deployment;

import java.io.IOException;
import java.io.Reader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.StreamSupport;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectMapper;
import org.yaml.snakeyaml.Yaml;

/** A parsed compose file, by default {@code docker/compose.yaml}, with its anchors resolved. */
record ComposeFile(JsonNode root) {
    static final Path FOLDER = Path.of("..", "docker");
    private static final Pattern SECRET = Pattern.compile("/run/secrets/(\\w+/\\w+)");

    static ComposeFile read() throws IOException {
        return read(FOLDER.resolve("compose.yaml"));
    }

    static ComposeFile read(Path file) throws IOException {
        try (Reader reader = Files.newBufferedReader(file)) {
            return new ComposeFile(new ObjectMapper().valueToTree(new Yaml().load(reader)));
        }
    }

    Map<String, JsonNode> services() {
        Map<String, JsonNode> services = new TreeMap<>();
        root.path("services").properties().forEach(service -> services.put(service.getKey(), service.getValue()));
        return services;
    }

    /** Commands of the services with this image and its own entrypoint, by name of the service. */
    Map<String, List<String>> commands(String image) {
        return services().entrySet().stream()
                .filter(service -> service.getValue().path("image").asText().equals(image)
                        && !service.getValue().has("entrypoint"))
                .collect(Collectors.toMap(Map.Entry::getKey, service -> arguments(service.getValue())));
    }

    /** Paths below {@code /run/secrets} that a service reads. */
    static Set<String> secrets(JsonNode service) {
        return SECRET.matcher(service.toString())
                .results()
                .map((MatchResult found) -> found.group(1))
                .collect(Collectors.toCollection(TreeSet::new));
    }

    private static List<String> arguments(JsonNode service) {
        return StreamSupport.stream(service.path("command").spliterator(), false)
                .map(JsonNode::asText)
                .toList();
    }
}
