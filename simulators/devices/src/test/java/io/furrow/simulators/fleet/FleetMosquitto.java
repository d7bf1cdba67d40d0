package io.furrow.simulators.fleet;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.KeyStore;
import java.util.Base64;
import java.util.concurrent.TimeUnit;

import org.awaitility.Awaitility;

import io.furrow.embedded.FreePort;
import io.furrow.process.Ports;
import io.furrow.process.TestProcess;

/** Eclipse Mosquitto as Debian packs it, on loopback, with a password file and TLS. */
final class FleetMosquitto {
    private static final String KEY_PASSWORD = "changeit";

    private final Path directory;
    private final int port = FreePort.orFree(0);
    private Process process;

    private FleetMosquitto(Path directory) {
        this.directory = directory;
    }

    /** A broker with one user, that runs. */
    static FleetMosquitto start(Path directory, String user, String password) throws Exception {
        FleetMosquitto broker = new FleetMosquitto(directory);
        broker.makeCertificate();
        run("mosquitto_passwd", "-b", "-c", broker.file("passwords"), user, password);
        Files.writeString(directory.resolve("mosquitto.conf"), """
                listener %d 127.0.0.1
                certfile %s
                keyfile %s
                password_file %s
                allow_anonymous false
                persistence true
                persistence_location %s/
                max_queued_messages 0
                set_tcp_nodelay true
                user %s
                """.formatted(
                        broker.port,
                        broker.file("certificate.pem"),
                        broker.file("key.pem"),
                        broker.file("passwords"),
                        directory,
                        System.getProperty("user.name")));
        broker.start();
        return broker;
    }

    /** Gives it one more user, while it runs. */
    void add(String user, String password) throws Exception {
        run("mosquitto_passwd", "-b", file("passwords"), user, password);
        run("kill", "-HUP", Long.toString(process.pid()));
    }

    URI uri() {
        return URI.create("ssl://127.0.0.1:" + port);
    }

    /** The certificate whom to trust. */
    Path certificate() {
        return directory.resolve("certificate.pem");
    }

    /** Stops it and starts it again on its port with its memory. */
    void restart() throws Exception {
        stop();
        start();
    }

    /** Ends it as the system does. */
    void stop() throws InterruptedException {
        process.destroy();
        if (!process.waitFor(10, TimeUnit.SECONDS)) {
            process.destroyForcibly();
        }
    }

    private void start() throws IOException {
        process = new ProcessBuilder(program("mosquitto"), "-c", file("mosquitto.conf"))
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.appendTo(
                        directory.resolve("mosquitto.log").toFile()))
                .start();
        Awaitility.await().until(() -> Ports.isListening(port));
    }

    /** A key and its certificate, which nobody has signed but itself. */
    private void makeCertificate() throws Exception {
        Path store = directory.resolve("store.p12");
        TestProcess.keytool("""
                -genkeypair -keystore %s -storetype PKCS12 -storepass %s -alias broker -keyalg RSA -dname CN=localhost \
                -ext san=ip:127.0.0.1,dns:localhost""".formatted(store, KEY_PASSWORD));
        KeyStore keys = KeyStore.getInstance(store.toFile(), KEY_PASSWORD.toCharArray());
        pem("certificate.pem", "CERTIFICATE", keys.getCertificate("broker").getEncoded());
        pem(
                "key.pem",
                "PRIVATE KEY",
                keys.getKey("broker", KEY_PASSWORD.toCharArray()).getEncoded());
    }

    private void pem(String name, String what, byte[] der) throws IOException {
        String text = Base64.getMimeEncoder(64, new byte[] {'\n'}).encodeToString(der);
        Files.writeString(
                directory.resolve(name), "-----BEGIN %s-----\n%s\n-----END %s-----\n".formatted(what, text, what));
    }

    private String file(String name) {
        return directory.resolve(name).toString();
    }

    private static void run(String... command) throws Exception {
        TestProcess.Ended ended = TestProcess.run(new ProcessBuilder(command));
        if (ended.status() != 0) {
            throw new IOException(command[0] + ", of the Debian package mosquitto, failed: " + ended.output());
        }
    }

    /** Debian has it where only administrators look for programs. */
    private static String program(String name) {
        Path administrators = Path.of("/usr/sbin", name);
        return Files.isExecutable(administrators) ? administrators.toString() : name;
    }
}
