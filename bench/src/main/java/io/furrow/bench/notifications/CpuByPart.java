package io.furrow.bench.notifications;

import java.lang.management.ManagementFactory;
import java.lang.management.ThreadInfo;
import java.lang.management.ThreadMXBean;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;

import com.sun.management.OperatingSystemMXBean;

/** Processor time of this JVM by part, attributed by thread names; the rest, used by no Java thread, is the JVM's own. */
public final class CpuByPart {
    private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();
    private static final OperatingSystemMXBean SYSTEM =
            (OperatingSystemMXBean) ManagementFactory.getOperatingSystemMXBean();

    /** Part by thread name prefix. */
    private static final Map<String, String> PARTS = new LinkedHashMap<>();

    /** Name of the sending thread. */
    static final String SENDER = "bench-sender";

    private static final String OTHERS = "other threads";
    private static final String JVM = "collector and compiler";

    static {
        PARTS.put(SENDER, "load generator");
        PARTS.put("bench-reader", "reader that checks");
        PARTS.put("bench-", "bench");
        PARTS.put("bare-server", "bare server");
        PARTS.put("ngsi-source-journal", "journal");
        PARTS.put("journal", "journal");
        PARTS.put("ngsi-journal", "journal");
        PARTS.put("ngsi-source", "listener");
        PARTS.put("task-thread", "Connect task");
        PARTS.put("kafka-producer-network-thread", "producer's network");
        PARTS.put("data-plane", "broker");
        PARTS.put("kafka-", "broker");
        PARTS.put("raft-", "broker");
        PARTS.put("quorum-", "broker");
    }

    private final Map<Long, Long> nanosByThread;
    private final long processNanos;

    private CpuByPart() {
        nanosByThread = new HashMap<>();
        for (long id : THREADS.getAllThreadIds()) {
            nanosByThread.put(id, THREADS.getThreadCpuTime(id));
        }
        processNanos = SYSTEM.getProcessCpuTime();
    }

    /** Takes a sample. */
    public static CpuByPart now() {
        return new CpuByPart();
    }

    /** Nanoseconds used by each part since the sample, the parts in a fixed order. */
    public Map<String, Long> since() {
        Map<String, Long> parts = new LinkedHashMap<>();
        PARTS.values().forEach(part -> parts.put(part, 0L));
        parts.put(OTHERS, 0L);
        CpuByPart now = now();
        long rest = now.processNanos - processNanos;
        for (Map.Entry<Long, Long> thread : now.nanosByThread.entrySet()) {
            long used = thread.getValue() - nanosByThread.getOrDefault(thread.getKey(), 0L);
            ThreadInfo info = THREADS.getThreadInfo(thread.getKey());
            if (used > 0 && info != null) {
                parts.merge(partOf(info.getThreadName()), used, Long::sum);
                rest -= used;
            }
        }
        parts.put(JVM, Math.max(0, rest));
        parts.values().removeIf(nanos -> nanos == 0);
        return parts;
    }

    private static String partOf(String thread) {
        return PARTS.entrySet().stream()
                .filter(part -> thread.startsWith(part.getKey()))
                .map(Map.Entry::getValue)
                .findFirst()
                .orElse(OTHERS);
    }
}
