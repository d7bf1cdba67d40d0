package io.furrow.soak.source;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** Adds, kills, removes and restarts workers of the NGSI source under load, and compares their answers with Kafka. */
public final class SourceWorkers {
    /**
     * The sum of all rounds.
     *
     * @param acknowledged changes whose notification was answered 2xx
     * @param missing acknowledged changes without a record of a notification in Kafka
     * @param doubled records beyond the number of notifications
     * @param otherIds records of a change that differ in {@code ce_id} from its first record
     * @param notNewest entities whose newest state in Kafka differs from the context broker's
     * @param unshown difference between records on disks and records shown by gauges
     * @param left maximum of {@code left-records}
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

    /** Arguments: folder, rounds, changes per second, exactly-once ({@code true} or {@code false}), fault to insert. */
    public static void main(String... args) throws Exception {
        boolean exactlyOnce = Boolean.parseBoolean(args[3]);
        var fault = PlantedFault.valueOf(args[4].toUpperCase(Locale.ROOT).replace('-', '_'));
        Outcome outcome =
                run(Path.of(args[0]), Integer.parseInt(args[1]), Integer.parseInt(args[2]), exactlyOnce, fault);
        System.out.println(outcome);
        List<String> faults = faults(outcome, exactlyOnce);
        if (outcome.left() == 0 && !args[1].equals("0")) {
            faults.add("no worker showed what a moved task left on its disk");
        }
        faults.forEach(System.out::println);
        System.exit(faults.isEmpty() ? 0 : 1);
    }

    /**
     * Runs the rounds, and prints the gauges of all workers in each step.
     *
     * @param rounds 0 for the short form: a worker is removed, and its disk is reused
     */
    static Outcome run(Path folder, int rounds, int perSecond, boolean exactlyOnce, PlantedFault fault)
            throws Exception {
        System.out.printf("exactly-once %s, %d changes/s%n", exactlyOnce ? "on" : "off", perSecond);
        try (WorkersRun run = WorkersRun.start(folder, perSecond, exactlyOnce, fault)) {
            if (rounds == 0) {
                run.removeAndReuseDisk();
            }
            for (int round = 1; round <= rounds; round++) {
                run.round(round);
            }
            return run.outcome();
        }
    }

    /** The faults in an outcome. */
    static List<String> faults(Outcome outcome, boolean exactlyOnce) {
        List<String> faults = new ArrayList<>();
        add(faults, outcome.acknowledged() == 0, "nothing was acknowledged");
        add(faults, outcome.missing() > 0, "of what was acknowledged, something is not in Kafka");
        add(faults, exactlyOnce && outcome.doubled() > 0, "something is in Kafka twice");
        add(faults, outcome.otherIds() > 0, "records of one change have different ids");
        add(faults, outcome.notNewest() > 0, "the newest state of an entity is not in Kafka");
        add(faults, outcome.unshown() != 0, "what is shown is not what is on the disks");
        add(faults, outcome.unavailable() == 0, "nothing was on the disk of a removed worker");
        return faults;
    }

    private static void add(List<String> faults, boolean isFault, String fault) {
        if (isFault) {
            faults.add(fault);
        }
    }
}
