package io.furrow.connect.source;

import java.util.HashMap;
import java.util.Map;

/**
 * A program: a source whose worker asks for nothing, as while Kafka is unavailable, with a small journal that is soon full. It prints
 * its port and runs until its input ends. Arguments: the journal's folder, and options as {@code name=value}.
 */
public final class BlockedSource {
    private BlockedSource() {}

    /** Runs it. */
    public static void main(String[] arguments) throws Exception {
        Map<String, String> options = new HashMap<>(Map.of(
                "name", "blocked",
                "listen.port", "0",
                "journal.dir", arguments[0],
                "journal.max.bytes", "67108864",
                "max.body.bytes", "2097152",
                "max.pending.bytes", "8388608",
                "overload.memory.bytes", "8388608",
                "overload.hold.ms", "1000"));
        for (int i = 1; i < arguments.length; i++) {
            String[] option = arguments[i].split("=", 2);
            options.put(option[0], option[1]);
        }
        NgsiSourceTask task = new NgsiSourceTask();
        task.initialize(new StubContext(options, new HashMap<>()));
        task.start(options);
        System.out.println("port " + task.port());
        System.out.flush();
        while (System.in.read() >= 0) {
            continue;
        }
        task.stop();
    }
}
