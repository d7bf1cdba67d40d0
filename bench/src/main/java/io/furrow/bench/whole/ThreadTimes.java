package io.furrow.bench.whole;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/** Processor time of a process's threads, by id. Linux records it for each, with the first 15 characters of its name. */
public record ThreadTimes(Map<String, Spent> threads) {
    /** Of one thread. */
    public record Spent(String role, long nanos, long switches) {
        private Spent since(Spent before) {
            return before == null ? this : new Spent(role, nanos - before.nanos, switches - before.switches);
        }
    }

    public static final String DEVICES = "devices, MQTT, stand-in";
    public static final String COMPILERS = "compilers of the JVM";
    static final String OTHERS = "everything else";

    /** Roles of threads by their names; the first match counts. */
    private static final Map<String, Pattern> ROLES = new LinkedHashMap<>();

    static {
        role(COMPILERS, "C1 Compiler|C2 Compiler|Sweeper");
        role("garbage collection, VM", "GC Thread|VM |G1 ");
        role(
                DEVICES,
                "load|MQTT |nioEventLoop|Session Exec|com.hivemq|furrow-iot-agen|furrow-notifier|context-broker|iot-agent"
                        + "|simulated-farm|device-host");
        role("NGSI source: HTTP, journal", "ngsi-source|journal|task-thread-ngs");
        role("Kafka broker", "data-plane|group-coord|kafka-1-|Txn|AddPart|Expiration");
        role("Kafka producers", "kafka-producer");
        role("Flink: readers of Kafka", "Source Data Fet");
        role("Flink: flush threads", "OutputFlusher");
        role(
                "Flink: checkpoints, control",
                "AsyncOper|jobmanager|flink-|Flink-|Checkpoint|SourceCoord|Time Trigger|System Time");
        role(
                "Flink: operators",
                "Source:|Assign|Read |Track|Match|Merge|Ensure|Dedup|Cast|Average|Watch the|missions to");
        role("farm watch and managers", "furrow-farm-wat|furrow-control");
        role("MongoDB stand-in", "mongo-server");
    }

    private static void role(String role, String beginnings) {
        ROLES.put(role, Pattern.compile(beginnings));
    }

    /** @throws IOException if the process has ended */
    public static ThreadTimes of(long pid) throws IOException {
        Map<String, Spent> threads = new HashMap<>();
        try (Stream<Path> tasks = Files.list(Path.of("/proc", Long.toString(pid), "task"))) {
            for (Path task : (Iterable<Path>) tasks::iterator) {
                try {
                    threads.put(task.getFileName().toString(), spent(task));
                } catch (IOException e) {
                    // That thread has ended since.
                }
            }
        }
        return new ThreadTimes(threads);
    }

    private static Spent spent(Path task) throws IOException {
        long switches = Files.readAllLines(task.resolve("status")).stream()
                .filter(line -> line.contains("ctxt_switches"))
                .mapToLong(line -> Long.parseLong(line.replaceAll("\\D", "")))
                .sum();
        long nanos = Long.parseLong(Files.readString(task.resolve("schedstat")).split(" ")[0]);
        return new Spent(role(Files.readString(task.resolve("comm")).strip()), nanos, switches);
    }

    static String role(String thread) {
        return ROLES.entrySet().stream()
                .filter(role -> role.getValue().matcher(thread).lookingAt())
                .map(Map.Entry::getKey)
                .findFirst()
                .orElse(OTHERS);
    }

    /** The time spent since an earlier sample, by threads that still exist. */
    public ThreadTimes since(ThreadTimes before) {
        Map<String, Spent> spent = new HashMap<>();
        threads.forEach((id, now) -> spent.put(id, now.since(before.threads.get(id))));
        return new ThreadTimes(spent);
    }

    /** Processor time by role, ns. */
    public Map<String, Long> byRole() {
        return threads.values().stream()
                .collect(Collectors.groupingBy(Spent::role, Collectors.summingLong(Spent::nanos)));
    }

    long switches() {
        return threads.values().stream().mapToLong(Spent::switches).sum();
    }
}
