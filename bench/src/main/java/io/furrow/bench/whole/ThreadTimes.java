package io.furrow.bench.whole;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Processor time of a process's threads, by id. Linux keeps it for each, with the first 15 characters of its name.
 */
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

    /** What threads do, by how their names begin; the first that fits counts. */
    private static final Map<String, List<String>> ROLES = roles();

    private static Map<String, List<String>> roles() {
        Map<String, List<String>> roles = new LinkedHashMap<>();
        roles.put(COMPILERS, List.of("C1 Compiler", "C2 Compiler", "Sweeper"));
        roles.put("garbage collection, VM", List.of("GC Thread", "VM ", "G1 "));
        roles.put(
                DEVICES,
                List.of(
                        "load",
                        "MQTT ",
                        "nioEventLoop",
                        "Session Exec",
                        "com.hivemq",
                        "furrow-iot-agen",
                        "furrow-notifier",
                        "context-broker",
                        "iot-agent",
                        "simulated-farm",
                        "device-host"));
        roles.put("NGSI source: HTTP, journal", List.of("ngsi-source", "journal", "task-thread-ngs"));
        roles.put("Kafka broker", List.of("data-plane", "group-coord", "kafka-1-", "Txn", "AddPart", "Expiration"));
        roles.put("Kafka producers", List.of("kafka-producer"));
        roles.put("Flink: readers of Kafka", List.of("Source Data Fet"));
        roles.put("Flink: flush threads", List.of("OutputFlusher"));
        roles.put(
                "Flink: checkpoints, control",
                List.of(
                        "AsyncOper",
                        "jobmanager",
                        "flink-",
                        "Flink-",
                        "Checkpoint",
                        "SourceCoord",
                        "Time Trigger",
                        "System Time"));
        roles.put(
                "Flink: operators",
                List.of(
                        "Source:",
                        "Assign",
                        "Read ",
                        "Track",
                        "Match",
                        "Merge",
                        "Ensure",
                        "Dedup",
                        "Cast",
                        "Average",
                        "Watch the",
                        "missions to"));
        roles.put("farm watch and managers", List.of("furrow-farm-wat", "furrow-control"));
        roles.put("MongoDB stand-in", List.of("mongo-server"));
        return roles;
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
                .filter(role -> role.getValue().stream().anyMatch(thread::startsWith))
                .map(Map.Entry::getKey)
                .findFirst()
                .orElse(OTHERS);
    }

    /** What was spent after an earlier look by the threads that are still there. */
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
