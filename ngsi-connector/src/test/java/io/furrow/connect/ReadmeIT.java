package io.furrow.connect;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.FreePort;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The three commands of the README bring the first record, run as they stand, on ports of the test. */
@Tag("full")
class ReadmeIT {
    private static final Pattern COMMAND = Pattern.compile("```\\n(curl.*?)\\n```", Pattern.DOTALL);

    @TempDir
    Path directory;

    @Test
    void bringsTheFirstRecordInThreeCommands() throws Exception {
        int port = FreePort.orFree(0);
        try (ConnectRig rig = ConnectRig.start(directory.resolve("rig"));
                FiwareStandIn orion = FiwareStandIn.start(new FiwareSettings(0, 0, null, null, null))) {
            List<String> commands = commands().stream()
                    .map(command -> command.replace("localhost:8083", rig.rest().getAuthority())
                            .replace("localhost:1026", orion.contextBroker().getAuthority())
                            .replace("127.0.0.1:8090", "127.0.0.1:" + port))
                    .toList();
            Path config = Files.createDirectories(directory.resolve("config"));
            String source = Files.readString(Path.of("config", "ngsi-source.json"))
                    .replace("\"8090\"", "\"" + port + "\"")
                    .replace("/var/lib/furrow", directory.resolve("var").toString());
            Files.writeString(config.resolve("ngsi-source.json"), source);

            assertThat(commands).hasSize(3);
            run(commands.get(0));
            rig.awaitRunning("ngsi-source");
            run(commands.get(1));
            run(commands.get(2));

            try (TopicReader raw = new TopicReader(rig.bootstrapServers(), "data.raw")) {
                assertThat(raw.atLeast(1))
                        .singleElement()
                        .satisfies(record -> assertThat(record.key()).isEqualTo("urn:ngsi-ld:Thermometer:1"));
            }
            await().untilAsserted(() ->
                    assertThat(run("curl http://127.0.0.1:" + port + "/health")).contains("\"produced\":1"));
        }
    }

    private static List<String> commands() throws IOException {
        String readme = Files.readString(Path.of("README.md"));
        int begin = readme.indexOf("## The first record");
        String part = readme.substring(begin, readme.indexOf("\n## ", begin));
        return COMMAND.matcher(part)
                .results()
                .map((MatchResult match) -> match.group(1))
                .toList();
    }

    private String run(String command) throws IOException, InterruptedException {
        ProcessBuilder shell =
                new ProcessBuilder("sh", "-c", command.replaceFirst("curl", "curl -sS --fail-with-body"));
        TestProcess.Ended ended = TestProcess.run(shell.directory(directory.toFile()));
        assertThat(ended.status()).as(command + "\n" + ended.output()).isZero();
        return ended.output();
    }
}
