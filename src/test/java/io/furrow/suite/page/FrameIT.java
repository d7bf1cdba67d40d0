package io.furrow.suite.page;

import org.assertj.core.api.Assertions;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

/** The frame around all views. */
@PageTest
@Tag("full")
class FrameIT {
    @Test
    void opensTheMapInLiveMode(FarmPage farm) {
        assertThat(farm.page()).hasTitle("Furrow");
        assertThat(farm.find(".mode")).hasText("Live");
        assertThat(farm.find("furrow-map canvas").first()).isVisible();
    }

    /** Tests of the page fail by errors in the window, so these must be detected. */
    @Test
    void detectsPolicyViolationsAndUncaughtExceptions(PageSuite suite) {
        FarmPage farm = suite.open("").expectingError(".");
        farm.run(
                "() => { setTimeout(() => { throw new Error('thrown by a test'); });"
                        + " const script = document.createElement('script'); script.textContent = 'window.ran = true'; document.body.append(script); }");

        farm.until(() -> farm.allErrors().stream().anyMatch(error -> error.contains("thrown by a test"))
                && farm.allErrors().stream().anyMatch(error -> error.contains("policy forbids script-src")));
        Assertions.assertThat(farm.run("window.ran")).isNull();
    }
}
