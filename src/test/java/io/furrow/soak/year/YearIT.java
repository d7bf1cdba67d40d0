package io.furrow.soak.year;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.launcher.Furrow;
import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

/** A month with days of five seconds; the long form is {@code ./furrow soak year}. Runs alone. */
@Timeout(540)
@Tag("full")
@Tag("page")
class YearIT {
    private static final int WEEKS = 4;

    @TempDir
    Path folder;

    @Test
    void passesAllChecksAfterEachWeekOfAMonth() throws Exception {
        try (FarmYear month = new FarmYear(furrow(), folder, WEEKS, Duration.ofSeconds(5))) {
            month.run();

            assertThat(month.differences()).isEmpty();
        }
    }

    /** The suite on this class path, because {@code ./furrow} would build another one. */
    private List<String> furrow() {
        String options = "-Xmx1g -XX:+UseParallelGC -Dfurrow.plugins=%s -Dfurrow.home=%s"
                .formatted(System.getProperty("furrow.plugins"), folder);
        return TestProcess.java(options, Furrow.class).command();
    }
}
