package io.furrow.soak;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Creates {@code data.raw} and {@value #NATIVE}, and writes the reports of the {@link SoakFarm} to both, numbered from
 * 1, at a steady rate: as events, and as the context broker's native notifications.
 */
public final class NumberedEvents {
    static final String NATIVE = "orion.native";

    private static final int PARTITIONS = 4;
    private static final int EVENTS_PER_SECOND = 40;
    private static final Duration STEP = Duration.ofSeconds(1).dividedBy(EVENTS_PER_SECOND);
    private static final FiwareScope SCOPE = FiwareScope.of("soak", "/");

    private NumberedEvents() {}

    /**
     * Arguments: bootstrap servers, seconds. Prints {@code writing} once the topic exists, and the total at the end.
     */
    public static void main(String... args) throws ExecutionException, InterruptedException {
        Properties kafka = new Properties();
        kafka.setProperty("bootstrap.servers", args[0]);
        createTopics(kafka);
        kafka.setProperty("enable.idempotence", "true");
        kafka.setProperty("acks", "all");
        kafka.setProperty("max.in.flight.requests.per.connection", "1"); // the topic was created just now
        try (var producer = new KafkaProducer<>(kafka, new StringSerializer(), new ByteArraySerializer())) {
            System.out.println("writing");
            long written = write(producer, Duration.ofSeconds(Long.parseLong(args[1])));
            System.out.println("wrote " + written + " events");
        }
    }

    private static void createTopics(Properties kafka) throws ExecutionException, InterruptedException {
        try (Admin admin = Admin.create(kafka)) {
            List<NewTopic> topics = Stream.of(Topics.RAW, NATIVE)
                    .map(topic -> new NewTopic(topic, Optional.of(PARTITIONS), Optional.empty()))
                    .toList();
            admin.createTopics(topics).all().get();
        }
    }

    private static long write(KafkaProducer<String, byte[]> producer, Duration duration) {
        AtomicReference<Exception> firstFailure = new AtomicReference<>();
        long startedAt = System.nanoTime();
        long events = duration.dividedBy(STEP);
        long time = 0;
        for (long number = 1; number <= events; number++) {
            LockSupport.parkNanos(startedAt + number * STEP.toNanos() - System.nanoTime());
            time = Math.max(time + 1, System.currentTimeMillis());
            Entity entity = SoakFarm.report(number, time);
            producer.send(event(entity, time), (written, failure) -> firstFailure.compareAndSet(null, failure));
            producer.send(notification(entity, time), (written, failure) -> firstFailure.compareAndSet(null, failure));
        }
        producer.flush();
        if (firstFailure.get() != null) {
            throw new IllegalStateException("an event was not written", firstFailure.get());
        }
        return events;
    }

    private static ProducerRecord<String, byte[]> notification(Entity entity, long time) {
        String body = "{\"subscriptionId\":\"soak\",\"data\":[" + new String(entity.toBytes(), UTF_8) + "]}";
        var record = new ProducerRecord<>(NATIVE, null, time, entity.id(), body.getBytes(UTF_8));
        record.headers().add(HeaderNames.SERVICE, SCOPE.service().getBytes(UTF_8));
        return record;
    }

    private static ProducerRecord<String, byte[]> event(Entity entity, long time) {
        Instant now = Instant.ofEpochMilli(time);
        var event = EntityEvent.of(entity, SCOPE, now, EventTimeRule.within(Duration.ZERO), Origin.NOTIFICATION);
        var record = new ProducerRecord<>(Topics.RAW, null, time, entity.id(), entity.toBytes());
        event.headers("/soak").forEach((name, text) -> record.headers().add(name, text.getBytes(UTF_8)));
        return record;
    }
}
