package io.furrow.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.FreePort;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A healthy run logs no warnings, since each warning makes an operator look for its cause. */
@Tag("full")
class HealthyLogIT {
    private static final Pattern WARNING = Pattern.compile("\\S+ +(WARN|ERROR|FATAL) .*");
    private static final Pattern AVERAGE = Pattern.compile("average +field-1 ");
    /** Windows last ten seconds: enough for several checkpoints of each job. */
    private static final long WINDOWS = 3;

    private static final List<String> PORTS =
            List.of("kafka connect flink notify mqtt orion iot-agent mongo control health dashboard".split(" "));

    @TempDir
    Path directory;

    @Test
    void logsNoWarningsInARunAtItsStopAndInTheNextRun() throws Exception {
        Path data = directory.resolve("data");
        // The same ports in both runs, as a user would have them.
        String ports = PORTS.stream()
                .map(name -> " --" + name + "-port " + FreePort.orFree(0))
                .collect(Collectors.joining());
        run("demo --data " + data + ports, "first", WINDOWS);
        run("demo --data " + data + ports, "second", 1);

        List<String> log = Files.readAllLines(data.resolve("furrow.log"));
        assertThat(log)
                .as("both runs and their stops")
                .filteredOn(line -> line.contains("Session Stopping"))
                .hasSize(2);
        assertThat(log).noneMatch(line -> WARNING.matcher(line).matches());
    }

    private void run(String arguments, String name, long windows) throws Exception {
        Path temporary = Files.createDirectory(directory.resolve(name));
        try (FurrowProcess furrow = FurrowProcess.start(temporary, arguments.split(" "))) {
            await().atMost(FurrowProcess.TIMEOUT).until(() -> {
                assertThat(furrow.isAlive()).as(furrow.printed()).isTrue();
                return AVERAGE.matcher(furrow.printed()).results().count() >= windows;
            });

            furrow.end("TERM");
        }
    }
}
