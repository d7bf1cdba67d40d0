package io.furrow.bench.analytics;

import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.analytics.collision.PositionFix;

/** A topic into which a fleet reports, and the topic of what is found in it. */
final class FleetTopic implements AutoCloseable {
    static final int PARTITIONS = 4;
    private static final short REPLICAS = 1;

    private final String name;
    private final Properties kafka;
    private final KafkaProducer<byte[], byte[]> producer;
    private final AtomicReference<Exception> failed = new AtomicReference<>();
    private volatile boolean stopped;
    private volatile long sent;

    private FleetTopic(String name, Properties kafka) {
        this.name = name;
        this.kafka = kafka;
        Properties properties = new Properties();
        properties.putAll(kafka);
        properties.setProperty("batch.size", "131072");
        properties.setProperty("linger.ms", "5");
        properties.setProperty("max.in.flight.requests.per.connection", "1"); // the topic was made just now
        producer = new KafkaProducer<>(properties, new ByteArraySerializer(), new ByteArraySerializer());
    }

    static FleetTopic create(String name, Properties kafka) throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(kafka)) {
            // What the fleet reports is of a time long past.
            Map<String, String> kept = Map.of("retention.ms", "-1");
            admin.createTopics(List.of(
                            new NewTopic(name, PARTITIONS, REPLICAS).configs(kept),
                            new NewTopic(name + ".found", PARTITIONS, REPLICAS).configs(kept)))
                    .all()
                    .get();
        }
        return new FleetTopic(name, kafka);
    }

    String name() {
        return name;
    }

    String results() {
        return name + ".found";
    }

    Properties kafka() {
        return kafka;
    }

    long sent() {
        return sent;
    }

    /** At the fleet's own event time, as fast as the broker takes them; returns when all are there. */
    void fill(int devices, long records) {
        Fleet fleet = new Fleet(devices, 0, 1);
        for (long tick = 0; sent < records; tick++) {
            fleet.tick(tick, fix -> send(fix, fix.time()));
        }
        producer.flush();
        check();
    }

    /** Each device once a second at the time of sending, until {@link #stop}. */
    void report(int devices, double side) {
        Fleet fleet = new Fleet(devices, 0, 1, side);
        long begin = System.currentTimeMillis();
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

    void stop() {
        stopped = true;
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread sends
    private void send(PositionFix fix, long time) {
        ProducerRecord<byte[], byte[]> record = RobotJson.record(name, fix, time);
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
            admin.deleteTopics(List.of(name, results()));
        }
        check();
    }
}
