package io.furrow.bench.analytics.load;

import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicFiller;

/** A topic of a fleet's reports, and the topic of the job's results. */
public final class FleetTopic implements AutoCloseable {
    public static final int PARTITIONS = 4;
    private static final String FOUND = ".found";
    private static final String OVERFLOWS = ".overflows";

    private final String name;
    private final Properties kafka;
    private final TopicFiller producer;
    private volatile boolean stopped;
    private volatile long sent;
    private volatile long begin;

    /** A source of reports. */
    public interface Reports {
        /** Emits the reports of a tick of {@link Fleet}, in order of time. */
        void tick(long tick, Consumer<PositionFix> out);
    }

    private FleetTopic(String name, Properties kafka) {
        this.name = name;
        this.kafka = kafka;
        producer = new TopicFiller(kafka, Map.of("batch.size", "131072", "linger.ms", "5"));
    }

    /** @param partitions of the topic of reports */
    public static FleetTopic create(String name, int partitions, Properties kafka)
            throws InterruptedException, ExecutionException {
        // The fleet's event times are long past.
        Map<String, String> retained = Map.of("retention.ms", "-1");
        Engines.makeTopics(kafka, partitions, retained, name);
        Engines.makeTopics(kafka, PARTITIONS, retained, name + FOUND, name + OVERFLOWS);
        return new FleetTopic(name, kafka);
    }

    public String name() {
        return name;
    }

    public String results() {
        return name + FOUND;
    }

    public String overflows() {
        return name + OVERFLOWS;
    }

    public Properties kafka() {
        return kafka;
    }

    public long sent() {
        return sent;
    }

    /** Writes reports at the fleet's own event time, as fast as possible; returns when all are written. */
    public void fill(int devices, long records) {
        Fleet fleet = new Fleet(devices, 0, 1);
        for (long tick = 0; sent < records; tick++) {
            fleet.tick(tick, fix -> send(fix, fix.time()));
        }
        producer.flush();
    }

    /**
     * The same for two partitions: devices of even number on the first, those of odd number on the second, with an
     * additional long attribute that slows reading.
     */
    public void fillUnevenly(int devices, long records, int padding) {
        Fleet fleet = new Fleet(devices, 0, 1);
        for (long tick = 0; sent < records; tick++) {
            fleet.tick(tick, fix -> {
                int partition = Fleet.number(fix) % 2;
                send(RobotJson.padded(name, partition, fix, fix.time(), partition * padding));
            });
        }
        producer.flush();
    }

    /** Reports each device once a second in real time, until {@link #stop}. */
    public void report(int devices, double side) {
        report(new Fleet(devices, 0, 1, side)::tick);
    }

    public void report(Reports fleet) {
        begin = System.currentTimeMillis();
        for (long tick = 0; !stopped; tick++) {
            fleet.tick(tick, fix -> {
                long due = begin + fix.time() - Fleet.START;
                for (long now = System.currentTimeMillis(); now < due && !stopped; now = System.currentTimeMillis()) {
                    LockSupport.parkNanos(1_000_000 * (due - now));
                }
                send(fix, due);
            });
        }
    }

    /** The time that {@link Fleet#START} is mapped to; 0 before the first report. */
    public long begin() {
        return begin;
    }

    public void stop() {
        stopped = true;
    }

    private void send(PositionFix fix, long time) {
        send(RobotJson.record(name, fix, time));
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread sends
    private void send(ProducerRecord<byte[], byte[]> record) {
        producer.send(record);
        sent++;
    }

    @Override
    public void close() {
        stop();
        try (Admin admin = Admin.create(kafka)) { // waits for the condition
            producer.close();
            admin.deleteTopics(List.of(name, results(), overflows()));
        }
    }
}
