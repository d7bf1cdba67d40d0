package io.furrow.soak.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.BitSet;
import java.util.Random;
import java.util.concurrent.locks.LockSupport;

import io.furrow.embedded.EmbeddedKafka;

/** Repeatedly kills the worker of the NGSI source under load, and compares its answers with the records in Kafka. */
public final class SourceKill {
    private static final int MIN_MILLIS = 1_000;
    private static final int MAX_MILLIS = 5_000;
    /** The tasks of a killed worker are reassigned after the session timeout. */
    private static final String[] SHORT_SESSION = {"session.timeout.ms=6000", "heartbeat.interval.ms=2000"};

    /**
     * The sum of all rounds.
     *
     * @param acknowledged notifications that were answered 200
     * @param missing acknowledged notifications that are not in Kafka
     * @param repeated records that were already in Kafka
     * @param repeatedWithAnotherId repeated records with another {@code ce_id}
     */
    public record Outcome(int acknowledged, int missing, int repeated, int repeatedWithAnotherId) {}

    private SourceKill() {}

    /** Arguments: folder, rounds, notifications per second, exactly-once ({@code true} or {@code false}), seed. */
    public static void main(String... args) throws Exception {
        boolean exactlyOnce = Boolean.parseBoolean(args[3]);
        Outcome outcome = run(
                Path.of(args[0]),
                Integer.parseInt(args[1]),
                Integer.parseInt(args[2]),
                exactlyOnce,
                Long.parseLong(args[4]));
        System.out.println(outcome);
        boolean good = outcome.acknowledged() > 0
                && outcome.missing() == 0
                && outcome.repeatedWithAnotherId() == 0
                && (!exactlyOnce || outcome.repeated() == 0);
        System.exit(good ? 0 : 1);
    }

    /** Runs the rounds and prints a line for each. */
    public static Outcome run(Path folder, int rounds, int perSecond, boolean exactlyOnce, long seed) throws Exception {
        System.out.printf("exactly-once %s, %d/s, seed %d%n", exactlyOnce ? "on" : "off", perSecond, seed);
        Random random = new Random(seed);
        BitSet acknowledged = new BitSet();
        int next = 0;
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"));
                SourceWorker worker = new SourceWorker(folder, kafka.bootstrapServers(), exactlyOnce, SHORT_SESSION)) {
            worker.start();
            worker.createSource();
            Outcome outcome = new Outcome(0, 0, 0, 0);
            for (int round = 1; round <= rounds; round++) {
                Duration load = Duration.ofMillis(random.nextInt(MIN_MILLIS, MAX_MILLIS));
                Senders senders = Senders.start(worker.port(), perSecond, next, acknowledged);
                LockSupport.parkNanos(load.toNanos());
                worker.kill();
                senders.stop();
                next = senders.next();
                worker.start();
                worker.awaitListening();
                worker.awaitDrained();
                outcome = compare(kafka.bootstrapServers(), acknowledged);
                System.out.printf("round %2d: killed after %d ms; %s%n", round, load.toMillis(), outcome);
            }
            return outcome;
        }
    }

    private static Outcome compare(String bootstrapServers, BitSet acknowledged) {
        try (DeliveredNotifications delivered = new DeliveredNotifications(bootstrapServers)) {
            delivered.read();
            return new Outcome(
                    acknowledged.cardinality(),
                    delivered.missingOf(acknowledged),
                    delivered.repeated(),
                    delivered.repeatedWithAnotherId());
        }
    }
}
