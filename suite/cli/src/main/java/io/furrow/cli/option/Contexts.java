package io.furrow.cli.option;

import java.io.IOException;
import java.io.Reader;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;
import java.util.stream.Stream;

import picocli.CommandLine.IDefaultValueProvider;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.ParameterException;

import io.furrow.model.file.FileProblem;

/**
 * The contexts of a user: properties files {@code NAME.properties} with defaults of options. $FURROW_CONTEXT, or else the
 * file {@code current}, names the one that is in use. Its token is for its own API only.
 */
public final class Contexts implements IDefaultValueProvider {
    /** The options of a context, and the environment variables that precede it. */
    private static final Map<String, List<String>> OPTIONS = Collections.unmodifiableMap(new TreeMap<>(Map.of(
            "api", List.of("FURROW_API"),
            "api-ca", List.of("FURROW_API_CA"),
            "mongo", List.of("FURROW_MONGO"),
            "output", List.of(),
            "token-file", List.of("FURROW_TOKEN", "FURROW_TOKEN_FILE"))));

    /** The API of a context that names none. */
    public static final String DEFAULT_API = "http://127.0.0.1:8085";

    private static final List<String> FILES = List.of("api-ca", "token-file");
    private static final String SUFFIX = ".properties";
    private static final String CURRENT = "current";
    private static final String VARIABLE = "FURROW_CONTEXT";

    private final Path folder;
    private final Map<String, String> environment;
    private Map<String, String> defaults;

    /** Those of the user. */
    public Contexts() {
        this(Path.of(System.getProperty("user.home"), ".config", "furrow"), System.getenv());
    }

    public Contexts(Path folder, Map<String, String> environment) {
        this.folder = folder;
        this.environment = environment;
    }

    /** The name of the context in use; null for none. */
    public String current() throws IOException {
        String named = environment.getOrDefault(VARIABLE, "").strip();
        if (!named.isEmpty()) {
            return named;
        }
        Path current = folder.resolve(CURRENT);
        return Files.exists(current) ? Files.readString(current).strip() : null;
    }

    /** Uses a context from now on, where $FURROW_CONTEXT names none. @param name null for none */
    public void use(String name) throws IOException {
        if (name == null) {
            Files.deleteIfExists(folder.resolve(CURRENT));
        } else {
            read(name);
            Files.writeString(folder.resolve(CURRENT), name + "\n");
        }
    }

    /** The names of all contexts, sorted. */
    public List<String> names() throws IOException {
        if (!Files.isDirectory(folder)) {
            return List.of();
        }
        try (Stream<Path> files = Files.list(folder)) {
            return files.map(file -> file.getFileName().toString())
                    .filter(file -> file.endsWith(SUFFIX))
                    .map(file -> file.substring(0, file.length() - SUFFIX.length()))
                    .sorted()
                    .toList();
        }
    }

    /**
     * The values of a context by option. Relative paths of files are resolved against the folder of the contexts.
     *
     * @throws IOException if there is no such context, or it has another key; the message says what to do
     */
    public Map<String, String> read(String name) throws IOException {
        if (!names().contains(name)) {
            throw new IOException("There is no context %s; write %s.".formatted(name, file(name)));
        }
        Properties properties = new Properties();
        try (Reader reader = Files.newBufferedReader(file(name))) {
            properties.load(reader);
        } catch (IOException | IllegalArgumentException e) {
            String reason = e instanceof IOException failure ? FileProblem.of(failure) : e.getMessage();
            throw new IOException("Context %s cannot be read (%s).".formatted(file(name), reason), e);
        }
        Map<String, String> values = new TreeMap<>();
        for (String option : properties.stringPropertyNames()) {
            if (!OPTIONS.containsKey(option)) {
                throw new IOException("%s has the unknown key '%s'; a context may have %s."
                        .formatted(file(name), option, String.join(", ", OPTIONS.keySet())));
            }
            String value = properties.getProperty(option).strip();
            values.put(option, FILES.contains(option) ? folder.resolve(value).toString() : value);
        }
        return values;
    }

    private Path file(String name) {
        return folder.resolve(name + SUFFIX);
    }

    /** The value of an option in the context in use, unless an environment variable precedes it. */
    @Override
    public String defaultValue(ArgSpec argument) {
        if (!(argument instanceof OptionSpec option)) {
            return null;
        }
        String name = option.longestName().replaceFirst("^--", "");
        return OPTIONS.containsKey(name) ? defaults(option).get(name) : null;
    }

    /** Whether an API is that of the context in use; its token must not be sent to another. */
    public boolean isOwnApi(URI api) throws IOException {
        String current = current();
        String own = current == null ? DEFAULT_API : read(current).getOrDefault("api", DEFAULT_API);
        return withoutSlash(own).equals(withoutSlash(api.toString()));
    }

    private static URI withoutSlash(String api) {
        return URI.create(api.replaceAll("/+$", ""));
    }

    private Map<String, String> defaults(OptionSpec option) {
        try {
            if (defaults == null) {
                defaults = defaults();
            }
            return defaults;
        } catch (IOException e) {
            throw new ParameterException(option.command().commandLine(), e.getMessage(), e);
        }
    }

    private Map<String, String> defaults() throws IOException {
        String current = current();
        if (current == null) {
            return Map.of();
        }
        Map<String, String> values = read(current);
        values.keySet().removeIf(option -> OPTIONS.get(option).stream().anyMatch(environment::containsKey));
        return values;
    }
}
