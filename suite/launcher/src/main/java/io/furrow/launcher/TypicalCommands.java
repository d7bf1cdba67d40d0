package io.furrow.launcher;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.Writer;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.nio.charset.StandardCharsets;

import com.sun.net.httpserver.HttpServer;

/** Runs short commands against a server of its own, so that the JVM loads their classes and can store them in a class archive. */
final class TypicalCommands {
    private static final byte[] MISSIONS =
            "[{\"mission\": \"m\", \"domain\": \"d\", \"status\": {\"state\": \"running\", \"devices\": 1, \"since\": 0}}]"
                    .getBytes(StandardCharsets.UTF_8);

    private TypicalCommands() {}

    public static void main(String... args) throws IOException {
        HttpServer server = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        server.createContext("/", exchange -> {
            exchange.getResponseHeaders().set("Content-Type", "application/json");
            exchange.sendResponseHeaders(200, MISSIONS.length);
            exchange.getResponseBody().write(MISSIONS);
            exchange.close();
        });
        server.start();
        String api = "http://127.0.0.1:" + server.getAddress().getPort();
        run("--help");
        run("mission", "list", "--api", api);
        run("mission", "list", "--api", api, "--output", "json");
        run("mission", "start", "m", "--domain", "d", "--api", api);
        run("device", "list", "--api", api);
        run("alarm", "list", "--api", api);
        run("status", "--api", api);
        server.stop(0);
    }

    private static void run(String... args) {
        Furrow.commandLine(args)
                .setOut(new PrintWriter(Writer.nullWriter()))
                .setErr(new PrintWriter(Writer.nullWriter()))
                .execute(args);
    }
}
