package io.furrow.soak.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.BitSet;
import java.util.concurrent.locks.LockSupport;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.soak.control.Until;

/** Stops Kafka under load for a while; the source must accept notifications meanwhile and catch up afterwards. */
public final class SourceOutage {
    private static final Duration WARM_UP = Duration.ofSeconds(15);
    private static final Duration POLL_INTERVAL = Duration.ofSeconds(10);
    /** The worker has a heap of 384 MiB, plus threads, classes, code and network buffers. */
    private static final long MAX_RESIDENT_MIB = 700;

    private SourceOutage() {}

    /** Arguments: folder, notifications per second, seconds of outage. */
    public static void main(String... args) throws Exception {
        Path folder = Path.of(args[0]);
        int perSecond = Integer.parseInt(args[1]);
        Duration outage = Duration.ofSeconds(Long.parseLong(args[2]));
        int port = FreePort.orFree(0);
        BitSet acknowledged = new BitSet();
        EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"), port);
        boolean good;
        try (SourceWorker worker = new SourceWorker(folder, kafka.bootstrapServers(), false)) {
            worker.start();
            worker.createSource();
            Senders senders = Senders.start(worker.port(), perSecond, 0, acknowledged);
            watch(worker, WARM_UP, "before");
            int sentBefore = senders.next();
            kafka.close();
            watch(worker, outage, "Kafka is stopped");
            int sentDuring = senders.next() - sentBefore;
            kafka = EmbeddedKafka.start(folder.resolve("kafka"), port);
            long restartedAt = System.nanoTime();
            long drained = catchUp(worker, restartedAt, perSecond);
            senders.stop();
            worker.awaitDrained();
            good = compare(kafka.bootstrapServers(), acknowledged, senders.next());
            System.out.printf(
                    "sent during the outage %d; drained %.1f s after Kafka was back%n", sentDuring, drained / 1e9);
            long peak = worker.peakResidentMib();
            System.out.printf("resident at most %d MiB; allowed are %d%n", peak, MAX_RESIDENT_MIB);
            good &= drained < outage.toNanos() && peak <= MAX_RESIDENT_MIB;
        } finally {
            kafka.close();
        }
        System.exit(good ? 0 : 1);
    }

    private static void watch(SourceWorker worker, Duration duration, String what) throws Exception {
        long end = System.nanoTime() + duration.toNanos();
        while (System.nanoTime() < end) {
            LockSupport.parkNanos(Math.min(POLL_INTERVAL.toNanos(), end - System.nanoTime()));
            show(worker, what);
        }
    }

    private static void show(SourceWorker worker, String what) throws Exception {
        System.out.printf(
                "%s: durable %d, pending %d, rejected %d, resident %d MiB%n",
                what,
                worker.health().path("durable").asLong(-1),
                worker.health().path("pending").asLong(-1),
                worker.health().path("rejectedUnavailable").asLong(-1),
                worker.residentMib());
    }

    /** Waits until fewer notifications are pending than arrive in a second, under the same load. */
    private static long catchUp(SourceWorker worker, long since, int perSecond) throws Exception {
        Until.isTrue("the journal has caught up", Duration.ofSeconds(300), () -> {
            long pending = worker.health().path("pending").asLong(Long.MAX_VALUE);
            return pending < perSecond;
        });
        long took = System.nanoTime() - since;
        show(worker, "caught up");
        return took;
    }

    private static boolean compare(String bootstrapServers, BitSet acknowledged, int sent) {
        try (DeliveredNotifications delivered = new DeliveredNotifications(bootstrapServers)) {
            delivered.read();
            int missing = delivered.missingOf(acknowledged);
            int unanswered = sent - acknowledged.cardinality();
            System.out.printf(
                    "sent about %d, acknowledged %d (not: about %d), missing %d, repeated %d, of these with another ce_id %d%n",
                    sent,
                    acknowledged.cardinality(),
                    unanswered,
                    missing,
                    delivered.repeated(),
                    delivered.repeatedWithAnotherId());
            // each sender may have drawn one more number when it was stopped
            return missing == 0 && delivered.repeatedWithAnotherId() == 0 && unanswered <= Senders.CONNECTIONS;
        }
    }
}
