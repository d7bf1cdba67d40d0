package io.furrow.deployment;

import java.io.IOException;
import java.io.RandomAccessFile;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.attribute.FileTime;
import java.nio.file.attribute.PosixFilePermissions;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;
import java.util.stream.Collectors;

import com.sun.net.httpserver.HttpServer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.FreePort;
import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Runs the scripts of the containers with a real Mosquitto, and with a stub of Flink's command that prints its arguments. */
class ContainerScriptsTest {
    private static final String PATHS = "/usr/sbin:/usr/bin:/bin";

    @TempDir
    Path directory;

    private final Map<String, String> states =
            new ConcurrentHashMap<>(Map.of("collision", "RUNNING", "presence", "FAILED"));
    private Path checkpoints;
    private HttpServer cluster;

    @BeforeEach
    void startCluster() throws IOException {
        cluster = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        cluster.createContext("/jobs/overview", exchange -> {
            byte[] body = "{\"jobs\":[%s]}"
                    .formatted(states.entrySet().stream()
                            .map(job ->
                                    "{\"jid\":\"0a1b\",\"name\":\"%s\",\"start-time\":1,\"state\":\"%s\",\"tasks\":{\"total\":1}}"
                                            .formatted(job.getKey(), job.getValue()))
                            .collect(Collectors.joining(",")))
                    .getBytes(StandardCharsets.UTF_8);
            exchange.sendResponseHeaders(200, body.length);
            exchange.getResponseBody().write(body);
            exchange.close();
        });
        cluster.start();
    }

    @AfterEach
    void stopCluster() {
        cluster.stop(0);
    }

    @BeforeEach
    void writeFlinkStub() throws IOException {
        checkpoints = directory.resolve("checkpoints");
        Path flink = Files.createDirectories(directory.resolve("flink/bin")).resolve("flink");
        Files.writeString(flink, """
            #!/bin/sh
            echo "$@"
            """);
        Files.setPosixFilePermissions(flink, PosixFilePermissions.fromString("rwxr-xr-x"));
    }

    @Test
    void submitsAJobThatDoesNotRun() throws Exception {
        assertThat(submit("jobs/analytics.jar", "temperature", "--window", "10s"))
                .isEqualTo("run -d jobs/analytics.jar temperature --window 10s --checkpoint-dir file://%s/temperature\n"
                        .formatted(checkpoints));
    }

    @Test
    void continuesFromTheNewestCompleteCheckpoint() throws Exception {
        completeCheckpoint("presence/first/chk-9", 60);
        Path newest = completeCheckpoint("presence/second/chk-2", 30);
        Files.createDirectories(checkpoints.resolve("presence/second/chk-3"));
        completeCheckpoint("ingest/other/chk-1", 0);

        assertThat(submit("jobs/analytics.jar", "presence"))
                .isEqualTo(
                        "run -d -s file://%s -claimMode claim jobs/analytics.jar presence --checkpoint-dir file://%s/presence\n"
                                .formatted(newest, checkpoints));
    }

    @Test
    void doesNotClaimASavepoint() throws Exception {
        completeCheckpoint("presence/first/chk-9", 60);
        Path savepoint = completeCheckpoint("presence/savepoint-0a1b", 30);

        assertThat(submit("jobs/analytics.jar", "presence"))
                .isEqualTo("run -d -s file://%s jobs/analytics.jar presence --checkpoint-dir file://%s/presence\n"
                        .formatted(savepoint, checkpoints));
    }

    @Test
    void submitsNoRunningJobTwice() throws Exception {
        assertThat(submit("jobs/analytics.jar", "collision")).isEmpty();
    }

    @Test
    void submitsAJobAgainThatTheClusterHasLost() throws Exception {
        Process submit = start(submitCommand("jobs/analytics.jar", "collision"), "1");
        try {
            Thread.sleep(1_500);
            assertThat(directory.resolve("out")).isEmptyFile();

            states.remove("collision");

            await().untilAsserted(() ->
                    assertThat(directory.resolve("out")).content().startsWith("run -d jobs/analytics.jar collision "));
        } finally {
            submit.destroy();
        }
    }

    @Tag("full")
    @Test
    void reloadsReplacedAccountsOfMosquitto() throws Exception {
        int port = FreePort.orFree(0);
        Path accounts = Files.createDirectory(directory.resolve("accounts"));
        Files.createDirectory(directory.resolve("data"));
        String settings = Files.readString(ComposeFile.FOLDER.resolve("mosquitto/mosquitto.conf"))
                .replace(
                        "listener 1883",
                        "listener %d 127.0.0.1\nuser %s".formatted(port, System.getProperty("user.name")))
                .replace("/mosquitto/config", accounts.toString())
                .replace("/mosquitto/data", directory.resolve("data").toString())
                .replace("/mosquitto/log", directory.toString());
        Path file = Files.writeString(directory.resolve("mosquitto.conf"), settings);
        Files.writeString(accounts.resolve("passwords"), "iot-agent:$7$101$ZWFybGllcg==$ZWFybGllcg==\n# of others\n");
        Path password = Files.writeString(directory.resolve("mqtt-password"), "plough\n");
        Process broker = start("mosquitto/run", file.toString(), accounts.toString(), password.toString());
        try {
            await().until(() -> publishes(port, "iot-agent", "plough"));
            assertThat(publishes(port, "iot-agent", "wrong")).isFalse();
            assertThat(start(probe(port)).waitFor()).isZero();
            assertThat(accounts.resolve("passwords")).content().endsWith("\n# of others\n");
            assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(accounts.resolve("passwords"))))
                    .isEqualTo("rw-------");

            replace(accounts.resolve("rules"), "user robot\ntopic readwrite #\n");
            Path passwords = Files.copy(accounts.resolve("passwords"), directory.resolve("new"));
            run("mosquitto_passwd", "-b", passwords.toString(), "robot", "harrow");
            replace(accounts.resolve("passwords"), Files.readString(passwords));

            await().until(() -> publishes(port, "robot", "harrow"));
            checkLogRotation(directory.resolve("mosquitto.log"), port);
        } finally {
            List<ProcessHandle> all = broker.descendants().toList();
            broker.destroy();
            assertThat(broker.waitFor(1, TimeUnit.MINUTES)).isTrue();
            assertThat(all).allSatisfy(process -> await().until(() -> !process.isAlive()));
        }
    }

    /** The log contains the users that connect, and is rotated when it is large. */
    private void checkLogRotation(Path log, int port) throws Exception {
        assertThat(log).content().contains("New client connected").contains("u'robot'");
        try (RandomAccessFile large = new RandomAccessFile(log.toFile(), "rw")) {
            large.setLength(50_000_001);
        }
        await().until(() -> Files.exists(log.resolveSibling("mosquitto.log.1")) && Files.exists(log));
        await().until(() ->
                publishes(port, "robot", "harrow") && Files.readString(log).contains("u'robot'"));
    }

    /** The health check of the compose file, for this broker. */
    private static List<String> probe(int port) throws IOException {
        List<String> arguments = new ArrayList<>();
        ComposeFile.read()
                .services()
                .get("mosquitto")
                .at("/healthcheck/test")
                .forEach(argument -> arguments.add(argument.asText()));
        assertThat(arguments.remove(0)).isEqualTo("CMD");
        arguments.addAll(List.of("-h", "127.0.0.1", "-p", Integer.toString(port)));
        return arguments;
    }

    private Path completeCheckpoint(String name, int secondsAgo) throws IOException {
        Path folder = Files.createDirectories(checkpoints.resolve(name));
        Path file = Files.createFile(folder.resolve("_metadata"));
        Files.setLastModifiedTime(file, FileTime.from(Instant.now().minusSeconds(secondsAgo)));
        return folder;
    }

    /** Replaces a file atomically, as the control plane does; appends a text that does not begin with the old one. */
    private void replace(Path file, String text) throws IOException {
        String old = Files.readString(file);
        Path temporary = Files.writeString(file.resolveSibling("fresh"), text.startsWith(old) ? text : old + text);
        Files.move(temporary, file, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
    }

    private static boolean publishes(int port, String user, String password) throws Exception {
        return run(
                        "mosquitto_pub",
                        "-h",
                        "127.0.0.1",
                        "-p",
                        Integer.toString(port),
                        "-u",
                        user,
                        "-P",
                        password,
                        "-q",
                        "1",
                        "-t",
                        "t",
                        "-m",
                        "m")
                == 0;
    }

    private static int run(String... arguments) throws Exception {
        return TestProcess.run(new ProcessBuilder(arguments)).status();
    }

    private String submit(String... arguments) throws Exception {
        assertThat(start(submitCommand(arguments), "0").waitFor(1, TimeUnit.MINUTES))
                .isTrue();
        return Files.readString(directory.resolve("out"));
    }

    private List<String> submitCommand(String... arguments) {
        List<String> command = new ArrayList<>(List.of(
                ComposeFile.FOLDER.resolve("flink/submit").toString(),
                "http://127.0.0.1:" + cluster.getAddress().getPort()));
        command.addAll(List.of(arguments));
        return command;
    }

    private Process start(String script, String... arguments) throws IOException {
        List<String> command =
                new ArrayList<>(List.of(ComposeFile.FOLDER.resolve(script).toString()));
        command.addAll(List.of(arguments));
        return start(command);
    }

    private Process start(List<String> command) throws IOException {
        return start(command, "0");
    }

    private Process start(List<String> command, String interval) throws IOException {
        ProcessBuilder builder = new ProcessBuilder(command)
                .redirectErrorStream(true)
                .redirectOutput(directory.resolve("out").toFile());
        builder.environment().put("PATH", PATHS);
        builder.environment().put("FLINK_HOME", directory.resolve("flink").toString());
        builder.environment().put("INTERVAL", interval);
        builder.environment().put("CHECKPOINTS", checkpoints.toString());
        builder.environment().put("XDG_CONFIG_HOME", directory.toString());
        return builder.start();
    }
}
