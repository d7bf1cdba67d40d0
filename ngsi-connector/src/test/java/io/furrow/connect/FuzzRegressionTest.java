package io.furrow.connect;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import java.util.stream.Stream;

import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.core.config.Configurator;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.connect.journal.FuzzJournal;
import io.furrow.connect.repair.FuzzPages;
import io.furrow.connect.sink.api.FuzzAnswers;
import io.furrow.connect.source.FuzzBodies;
import io.furrow.connect.source.http.FuzzGzip;
import io.furrow.connect.source.journal.FuzzRecords;
import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * What the fuzzer begins with and what it once found, in {@code src/test/resources/fuzz}, each of it whole, cut short and with
 * random bytes changed. The fuzzer itself: {@code ./furrow soak fuzz}.
 */
@Tag("full")
class FuzzRegressionTest {
    private static final Path FUZZ = Path.of("src/test/resources/fuzz");
    private static final List<String> LOGGERS =
            List.of("io.furrow.connect.journal", "io.furrow.connect.repair", "io.furrow.connect.sink");

    interface Target {
        void accept(byte[] input) throws Exception;
    }

    static Stream<Arguments> targets() {
        return Stream.of(
                target("bodies", FuzzBodies::fuzzerTestOneInput, 500),
                target("records", FuzzRecords::fuzzerTestOneInput, 500),
                target("journal", FuzzJournal::fuzzerTestOneInput, 50),
                target("pages", FuzzPages::fuzzerTestOneInput, 100),
                target("answers", FuzzAnswers::fuzzerTestOneInput, 300),
                target("gzip", FuzzGzip::fuzzerTestOneInput, 100));
    }

    private static Arguments target(String corpus, Target target, int changes) {
        return Arguments.of(corpus, target, changes);
    }

    /** What is wrong with the inputs is no news. */
    @BeforeAll
    static void logNoDamage() {
        LOGGERS.forEach(logger -> Configurator.setLevel(logger, Level.OFF));
    }

    @AfterAll
    static void logAgain() {
        LOGGERS.forEach(logger -> Configurator.setLevel(logger, Level.INFO));
        FuzzGzip.close();
    }

    @ParameterizedTest(name = "{0}")
    @MethodSource("targets")
    void readsAny(String corpus, Target target, int changes) throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (byte[] input : inputs(corpus)) {
            accept(target, input, "as it is");
            for (int i = 0; i < changes; i++) {
                byte[] changed = Arrays.copyOf(input, 1 + random.nextInt(input.length));
                changed[random.nextInt(changed.length)] = (byte) random.nextInt(256);
                accept(target, changed, "seed " + seed);
            }
        }
    }

    private static void accept(Target target, byte[] input, String what) {
        try {
            target.accept(input);
        } catch (Exception | StackOverflowError e) {
            throw new AssertionError(what + ": " + java.util.HexFormat.of().formatHex(input), e);
        }
    }

    private static List<byte[]> inputs(String corpus) throws IOException {
        List<Path> sorted = Folders.list(FUZZ.resolve(corpus));
        assertThat(sorted).isNotEmpty();
        List<byte[]> inputs = new java.util.ArrayList<>();
        for (Path file : sorted) {
            inputs.add(Files.readAllBytes(file));
        }
        return inputs;
    }
}
