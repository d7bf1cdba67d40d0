package io.furrow.soak.source;

import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;

import io.furrow.embedded.EmbeddedConnect;

/** Runs a distributed Connect worker; arguments: bootstrap servers, plugin folder, REST port, name=value settings. */
public final class WorkerMain {
    private WorkerMain() {}

    public static void main(String... args) {
        Map<String, String> settings = new HashMap<>();
        for (int i = 3; i < args.length; i++) {
            settings.put(args[i].substring(0, args[i].indexOf('=')), args[i].substring(args[i].indexOf('=') + 1));
        }
        EmbeddedConnect worker = EmbeddedConnect.start(args[0], Path.of(args[1]), Integer.parseInt(args[2]), settings);
        System.out.println("worker at " + worker.uri());
    }
}
