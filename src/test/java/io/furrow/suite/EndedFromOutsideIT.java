package io.furrow.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/**
 * A command that is terminated by a signal leaves nothing in the temporary directory, whichever engine runs by then.
 */
@Tag("full")
class EndedFromOutsideIT {
    @TempDir
    Path directory;

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    bench load --warmup 0 --devices 20      | NGSI source and sink | TERM
                    bench notifications                     | Kafka Connect        | HUP
                    bench control                           | managers             | TERM
                    bench analytics --parts KAFKA           | Flink                | INT
                    bench fleet --devices 10                |                      | TERM
                    """)
    void leavesNoFolder(String arguments, String ready, String signal) throws Exception {
        Path temporary = Files.createDirectory(directory.resolve("tmp"));
        try (FurrowProcess furrow = FurrowProcess.start(temporary, arguments.split(" "))) {
            await().atMost(FurrowProcess.TIMEOUT).until(() -> {
                assertThat(furrow.isAlive()).as(furrow.printed()).isTrue();
                return ready == null
                        ? !kafkaFiles(temporary).isEmpty()
                        : furrow.printed().matches("(?s).*" + ready + " +ready after.*");
            });
            assertThat(kafkaFiles(temporary)).isNotEmpty();

            furrow.end(signal);
        }

        assertThat(Folders.list(temporary).stream()
                        .filter(file -> file.getFileName().toString().startsWith("furrow-")))
                .isEmpty();
    }

    private static List<Path> kafkaFiles(Path temporary) throws Exception {
        try (Stream<Path> files = Files.walk(temporary)) {
            return files.filter(file -> file.endsWith("meta.properties")).toList();
        } catch (java.io.UncheckedIOException e) { // a file was deleted meanwhile
            return List.of();
        }
    }
}
