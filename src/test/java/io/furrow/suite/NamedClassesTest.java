package io.furrow.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Set;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

/** Pages that guide readers into the code name only existing classes. */
class NamedClassesTest {
    private static final Path ROOT = Path.of("..");
    /** A class in code style, without or with packages: {@code collision/CollisionEntity}. */
    private static final Pattern CLASS = Pattern.compile("`(?:[a-z]+/)*([A-Z][A-Za-z0-9]+)(?:\\.\\w+)?`");

    @ParameterizedTest
    @ValueSource(strings = {"architecture.md", "changes.md"})
    void exist(String page) throws IOException {
        String text = Files.readString(ROOT.resolve("docs").resolve(page));
        Set<String> named =
                CLASS.matcher(text).results().map(result -> result.group(1)).collect(Collectors.toSet());

        assertThat(named).hasSizeGreaterThan(20);
        assertThat(classes()).containsAll(named);
    }

    @ParameterizedTest
    @ValueSource(strings = "changes.md")
    void areInTheNamedPackages(String page) throws IOException {
        String text = Files.readString(ROOT.resolve("docs").resolve(page));
        Set<String> places = Pattern.compile("`((?:[a-z]+/)+[A-Z][A-Za-z0-9]+)`")
                .matcher(text)
                .results()
                .map((MatchResult result) -> result.group(1))
                .collect(Collectors.toSet());

        assertThat(places)
                .hasSizeGreaterThan(20)
                .allSatisfy(place -> assertThat(sources()).anyMatch(source -> source.endsWith("/" + place + ".java")));
    }

    private static Set<String> classes() throws IOException {
        return sources().stream()
                .map(source -> source.substring(source.lastIndexOf('/') + 1).replace(".java", ""))
                .collect(Collectors.toSet());
    }

    private static Set<String> sources() throws IOException {
        try (Stream<Path> modules = Files.walk(ROOT, 2)) {
            return modules.map(module -> module.resolve("src"))
                    .filter(Files::isDirectory)
                    .flatMap(NamedClassesTest::javaFiles)
                    .collect(Collectors.toSet());
        }
    }

    private static Stream<String> javaFiles(Path folder) {
        try (Stream<Path> files = Files.walk(folder)) {
            return files.map(Path::toString).filter(file -> file.endsWith(".java")).toList().stream();
        } catch (IOException e) {
            throw new java.io.UncheckedIOException(e);
        }
    }
}
