package io.furrow.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.MatchResult;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Each decision states its status below the title, with newer decisions that changed it; the list of decisions states
 * the same.
 */
class DecisionsTest {
    private static final Path FOLDER = Path.of("..", "docs", "adr");
    private static final Pattern STATUS = Pattern.compile("Status: (?:accepted|(replaced|amended) by (.+))");
    private static final Pattern NEWER = Pattern.compile("\\[(\\d{4})]\\((\\1-[a-z0-9-]+\\.md)\\)");

    @ParameterizedTest
    @MethodSource("decisions")
    void statusNamesTheDecisionsThatChangedIt(String decision) throws IOException {
        String line = Files.readAllLines(FOLDER.resolve(decision)).get(2);
        Matcher status = STATUS.matcher(line);
        assertThat(status.matches()).as(line).isTrue();

        String note = "";
        if (status.group(1) != null) {
            List<MatchResult> newer = NEWER.matcher(status.group(2)).results().toList();
            assertThat(status.group(2))
                    .isEqualTo(newer.stream().map(MatchResult::group).collect(Collectors.joining(", ")));
            assertThat(newer).isNotEmpty().allSatisfy(each -> {
                assertThat(FOLDER.resolve(each.group(2))).exists();
                assertThat(each.group(2)).isGreaterThan(decision);
            });
            note = newer.stream()
                    .map(each -> each.group(1))
                    .collect(Collectors.joining(", ", " (" + status.group(1) + " by ", ")"));
        }
        String row = "| [%s](%s) | ".formatted(decision.substring(0, 4), decision);
        assertThat(Files.readAllLines(FOLDER.resolve("README.md")))
                .filteredOn(each -> each.startsWith(row))
                .singleElement()
                .asString()
                .matches(Pattern.quote(row) + "(?:(?! by \\d{4}).)*" + Pattern.quote(note + " |"));
    }

    private static List<String> decisions() throws IOException {
        return Folders.list(FOLDER).stream()
                .map(file -> file.getFileName().toString())
                .filter(name -> name.matches("\\d{4}-.*\\.md"))
                .toList();
    }
}
