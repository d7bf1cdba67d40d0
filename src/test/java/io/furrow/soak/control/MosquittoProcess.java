package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;

import io.furrow.embedded.FreePort;
import io.furrow.process.Ports;

/** Eclipse Mosquitto on loopback, whose accounts are in files that another program may change. */
public final class MosquittoProcess implements AutoCloseable {
    public static final String AGENT = "agent";
    public static final String AGENT_PASSWORD = "plough";
    private static final Duration START_TIMEOUT = Duration.ofSeconds(20);

    private final int port = FreePort.orFree(0);
    private final Path folder;
    private Process process;

    /** With the IoT Agent's user only. */
    public MosquittoProcess(Path folder) throws IOException, InterruptedException {
        this(folder, "");
    }

    /** @param settings further lines of its configuration */
    public MosquittoProcess(Path folder, String settings) throws IOException, InterruptedException {
        this.folder = Files.createDirectories(folder);
        run("mosquitto_passwd", "-b", "-c", passwords().toString(), AGENT, AGENT_PASSWORD);
        Files.write(rules(), List.of("user " + AGENT, "topic readwrite #"));
        Files.writeString(folder.resolve("mosquitto.conf"), """
                listener %d 127.0.0.1
                password_file %s
                acl_file %s
                allow_anonymous false
                set_tcp_nodelay true
                user %s
                %s
                """.formatted(
                        port, passwords(), rules(), System.getProperty("user.name"), settings));
    }

    public URI uri() {
        return URI.create("tcp://127.0.0.1:" + port);
    }

    public Path passwords() {
        return folder.resolve("passwords");
    }

    public Path rules() {
        return folder.resolve("rules");
    }

    /** A shell command that makes it reload both files; fails while it is not running. */
    public String reload() {
        return "kill -HUP $(cat " + pidFile() + ")";
    }

    private Path pidFile() {
        return folder.resolve("mosquitto.pid");
    }

    /** The users in the password file, except the agent's. */
    Set<String> users() throws IOException {
        Set<String> users = new TreeSet<>();
        for (String line : Files.readAllLines(passwords())) {
            if (!line.startsWith("#") && line.contains(":")) {
                users.add(line.substring(0, line.indexOf(':')));
            }
        }
        users.remove(AGENT);
        return users;
    }

    public void start() throws IOException {
        process = new ProcessBuilder(
                        program("mosquitto"),
                        "-c",
                        folder.resolve("mosquitto.conf").toString())
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.appendTo(
                        folder.resolve("mosquitto.log").toFile()))
                .start();
        Files.writeString(pidFile(), Long.toString(process.pid()));
        Until.isTrue("Mosquitto listens", START_TIMEOUT, () -> Ports.isListening(port));
    }

    public void kill() throws IOException, InterruptedException {
        Files.deleteIfExists(pidFile());
        process.destroyForcibly().waitFor();
    }

    private static void run(String... command) throws IOException, InterruptedException {
        if (new ProcessBuilder(command).redirectErrorStream(true).start().waitFor() != 0) {
            throw new IOException(command[0] + " failed; it is part of the Debian package mosquitto");
        }
    }

    /** On Debian the program is in {@code /usr/sbin}, which may not be on the path. */
    private static String program(String name) {
        Path installed = Path.of("/usr/sbin", name);
        return Files.isExecutable(installed) ? installed.toString() : name;
    }

    @Override
    public void close() {
        if (process != null) {
            process.destroyForcibly();
        }
    }
}
