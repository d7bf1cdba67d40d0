package io.furrow.soak.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.BitSet;
import java.util.Random;
import java.util.concurrent.locks.LockSupport;

import io.furrow.embedded.EmbeddedKafka;

/** Kills the worker of the NGSI source under load, again and again, and compares what it answered with what is in Kafka. */
public final class SourceKill {
    private static final Duration MIN = Duration.ofSeconds(1);
    private static final int SPREAD_MS = 4000;
    /** A killed worker keeps its tasks until the group misses it. */
    private static final String[] SOON_MISSED = {"session.timeout.ms=6000", "heartbeat.interval.ms=2000"};

    /**
     * All rounds added up.
     *
     * @param acknowledged notifications that were answered 200
     * @param missing those of them that are not in Kafka
     * @param repeated records that were in Kafka before
     * @param repeatedWithAnotherId those of them with another {@code ce_id}
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

    /** Each round prints a line. */
    public static Outcome run(Path folder, int rounds, int perSecond, boolean exactlyOnce, long seed) throws Exception {
        System.out.printf("exactly-once %s, %d/s, seed %d%n", exactlyOnce ? "on" : "off", perSecond, seed);
        Random random = new Random(seed);
        BitSet acknowledged = new BitSet();
        int next = 0;
        try (EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"));
                SourceWorker worker = new SourceWorker(folder, kafka.bootstrapServers(), exactlyOnce, SOON_MISSED)) {
            worker.start();
            worker.createSource();
            Outcome outcome = new Outcome(0, 0, 0, 0);
            for (int round = 1; round <= rounds; round++) {
                Duration load = MIN.plusMillis(random.nextInt(SPREAD_MS));
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
