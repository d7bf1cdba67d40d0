package io.furrow.soak.source;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** Adds, kills, removes and brings back workers of the NGSI source under load, and compares what was answered with Kafka. */
public final class SourceWorkers {
    /**
     * All rounds added up.
     *
     * @param acknowledged changes whose notification was answered 2xx
     * @param missing those of them that no notification brought to Kafka
     * @param doubled records that were there more often than their notification was sent
     * @param otherIds records of a change that had a record with another {@code ce_id}
     * @param notNewest entities whose newest state in Kafka is not that of the context broker
     * @param unshown records on a disk that were not shown, or were shown and not there
     * @param left the most that {@code left-records} showed
     * @param unavailable records that were on the disks of removed workers
     * @param repaired records that were read from the context broker
     */
    public record Outcome(
            int acknowledged,
            int missing,
            int doubled,
            int otherIds,
            int notNewest,
            long unshown,
            long left,
            int unavailable,
            int repaired) {}

    private SourceWorkers() {}

    /** Arguments: folder, rounds, changes per second, exactly-once ({@code true} or {@code false}), planted fault. */
    public static void main(String... args) throws Exception {
        boolean exactlyOnce = Boolean.parseBoolean(args[3]);
        var fault = PlantedFault.valueOf(args[4].toUpperCase(Locale.ROOT).replace('-', '_'));
        Outcome outcome =
                run(Path.of(args[0]), Integer.parseInt(args[1]), Integer.parseInt(args[2]), exactlyOnce, fault);
        System.out.println(outcome);
        List<String> wrong = wrong(outcome, exactlyOnce);
        if (outcome.left() == 0 && !args[1].equals("0")) {
            wrong.add("no worker showed what a moved task left on its disk");
        }
        wrong.forEach(System.out::println);
        System.exit(wrong.isEmpty() ? 0 : 1);
    }

    /**
     * Each step prints what the workers show.
     *
     * @param rounds 0 for the short form: a worker removed, and its disk brought back
     */
    static Outcome run(Path folder, int rounds, int perSecond, boolean exactlyOnce, PlantedFault fault)
            throws Exception {
        System.out.printf("exactly-once %s, %d changes/s%n", exactlyOnce ? "on" : "off", perSecond);
        try (WorkersRun run = WorkersRun.start(folder, perSecond, exactlyOnce, fault)) {
            if (rounds == 0) {
                run.removeAndComeBack();
            }
            for (int round = 1; round <= rounds; round++) {
                run.round(round);
            }
            return run.outcome();
        }
    }

    /** What must not be; empty if all is well. */
    static List<String> wrong(Outcome outcome, boolean exactlyOnce) {
        List<String> wrong = new ArrayList<>();
        add(wrong, outcome.acknowledged() == 0, "nothing was acknowledged");
        add(wrong, outcome.missing() > 0, "of what was acknowledged, something is not in Kafka");
        add(wrong, exactlyOnce && outcome.doubled() > 0, "something is in Kafka twice");
        add(wrong, outcome.otherIds() > 0, "records of one change have different ids");
        add(wrong, outcome.notNewest() > 0, "the newest state of an entity is not in Kafka");
        add(wrong, outcome.unshown() != 0, "what is shown is not what is on the disks");
        add(wrong, outcome.unavailable() == 0, "nothing was on the disk of a removed worker");
        return wrong;
    }

    private static void add(List<String> wrong, boolean is, String what) {
        if (is) {
            wrong.add(what);
        }
    }
}
