package io.furrow.connect;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.Pattern;

import org.junit.jupiter.api.Test;

import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;

/** The page for those who come from other connectors names a test for every row, and each test exists. */
class MigratingPageTest {
    private static final Path PAGE = Path.of("docs", "migrating.md");
    private static final Pattern NAMED = Pattern.compile("`(\\w+(?:Test|IT))\\.(\\w+)`");

    @Test
    void namesTestsThatExist() throws IOException {
        var named = NAMED.matcher(Files.readString(PAGE)).results().toList();

        assertThat(named)
                .hasSizeGreaterThan(20)
                .allSatisfy(test ->
                        assertThat(source(test.group(1))).as(test.group()).contains("void " + test.group(2) + "("));
    }

    @Test
    void hasATestForEveryRow() throws IOException {
        List<String> rows = Files.readAllLines(PAGE).stream()
                .filter(line -> line.startsWith("| ") && !line.startsWith("| wish"))
                .toList();

        assertThat(rows)
                .hasSizeGreaterThan(10)
                .allSatisfy(row -> assertThat(row).containsPattern(NAMED));
    }

    private static String source(String test) throws IOException {
        for (Path root : List.of(Path.of("src/test/java"), Path.of("../kit/model/src/test/java"))) {
            List<Path> found = Folders.walk(root).stream()
                    .filter(file -> file.endsWith(test + ".java"))
                    .toList();
            if (!found.isEmpty()) {
                return Files.readString(found.get(0));
            }
        }
        return "";
    }
}
