package io.furrow.bench.analytics.load;

import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.analytics.position.PositionFix;

/** A topic into which a fleet reports, and the topic of what is found in it. */
public final class FleetTopic implements AutoCloseable {
    public static final int PARTITIONS = 4;
    private static final short REPLICAS = 1;
    private static final String FOUND = ".found";
    private static final String OVERFLOWS = ".overflows";

    private final String name;
    private final int partitions;
    private final Properties kafka;
    private final KafkaProducer<byte[], byte[]> producer;
    private final AtomicReference<Exception> failed = new AtomicReference<>();
    private volatile boolean stopped;
    private volatile long sent;
    private volatile long begin;

    /** Devices that report. */
    public interface Reports {
        /** What they report within a tick of {@link Fleet}, in the order of time. */
        void tick(long tick, Consumer<PositionFix> out);
    }

    private FleetTopic(String name, int partitions, Properties kafka) {
        this.name = name;
        this.partitions = partitions;
        this.kafka = kafka;
        Properties properties = new Properties();
        properties.putAll(kafka);
        properties.setProperty("batch.size", "131072");
        properties.setProperty("linger.ms", "5");
        properties.setProperty("max.in.flight.requests.per.connection", "1"); // the topic was made just now
        producer = new KafkaProducer<>(properties, new ByteArraySerializer(), new ByteArraySerializer());
    }

    public static FleetTopic create(String name, Properties kafka) throws InterruptedException, ExecutionException {
        return create(name, PARTITIONS, kafka);
    }

    /** @param partitions of the topic into which the fleet reports */
    public static FleetTopic create(String name, int partitions, Properties kafka)
            throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(kafka)) {
            // What the fleet reports is of a time long past.
            Map<String, String> kept = Map.of("retention.ms", "-1");
            admin.createTopics(List.of(
                            new NewTopic(name, partitions, REPLICAS).configs(kept),
                            new NewTopic(name + FOUND, PARTITIONS, REPLICAS).configs(kept),
                            new NewTopic(name + OVERFLOWS, PARTITIONS, REPLICAS).configs(kept)))
                    .all()
                    .get();
        }
        return new FleetTopic(name, partitions, kafka);
    }

    public String name() {
        return name;
    }

    /** Into which the fleet reports. */
    public int partitions() {
        return partitions;
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

    /** At the fleet's own event time, as fast as the broker takes them; returns when all are there. */
    public void fill(int devices, long records) {
        Fleet fleet = new Fleet(devices, 0, 1);
        for (long tick = 0; sent < records; tick++) {
            fleet.tick(tick, fix -> send(fix, fix.time()));
        }
        producer.flush();
        check();
    }

    /**
     * The same for two partitions: devices of even number on the first, those of odd number on the second, with so long an
     * attribute beside the others that these take longer to read.
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
        check();
    }

    /** Each device once a second at the time of sending, until {@link #stop}. */
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

    /** The time that stands for {@link Fleet#START}; 0 before anything is reported. */
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
        producer.send(record, (done, failure) -> failed.compareAndSet(null, failure));
        sent++;
    }

    private void check() {
        if (failed.get() != null) {
            throw new IllegalStateException("topic " + name + " could not be written", failed.get());
        }
    }

    @Override
    public void close() {
        stop();
        producer.close();
        try (Admin admin = Admin.create(kafka)) { // waits for what it was asked
            admin.deleteTopics(List.of(name, results(), overflows()));
        }
        check();
    }
}
