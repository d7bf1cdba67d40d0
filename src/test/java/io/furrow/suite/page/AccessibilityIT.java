package io.furrow.suite.page;

import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

import com.deque.html.axecore.playwright.AxeBuilder;
import com.deque.html.axecore.results.Rule;
import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** Checks each view by axe-core's rules of WCAG 2.2, levels A and AA: no serious violations. */
@PageTest
@Tag("full")
class AccessibilityIT {
    private static final List<String> RULES =
            List.of("wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice");
    private static final Set<String> SERIOUS = Set.of("serious", "critical");

    private static final List<String> VIEWS = List.of("map", "missions", "replays", "analyses", "topics", "platform");

    static Stream<WindowStyle> styles() {
        return Stream.of(WindowStyle.DESKTOP, WindowStyle.PHONE_LIGHT);
    }

    @ParameterizedTest
    @MethodSource("styles")
    void hasNoSeriousViolation(WindowStyle style, PageSuite suite) {
        FarmPage farm = suite.open("", style);
        farm.untilStore("store.entities.size >= 17 && store.alarms.size > 0");
        for (String view : VIEWS) {
            farm.open("#/" + view);
            assertThat(
                            view.equals("map")
                                    ? farm.find("furrow-map canvas").first()
                                    : farm.find("furrow-" + view + " h1"))
                    .isVisible();
            assertThat(farm.find("furrow-" + view + " .skeleton:visible")).hasCount(0);

            List<String> violations = new AxeBuilder(farm.page())
                    .withTags(RULES).analyze().getViolations().stream()
                            .filter(rule -> SERIOUS.contains(rule.getImpact()))
                            .map(AccessibilityIT::describe)
                            .toList();
            Assertions.assertThat(violations).as(view).isEmpty();
        }
    }

    private static String describe(Rule rule) {
        return rule.getImpact() + " " + rule.getId() + ": "
                + rule.getNodes().stream()
                        .map(node -> node.getHtml() + " " + node.getFailureSummary())
                        .limit(4)
                        .toList();
    }
}
