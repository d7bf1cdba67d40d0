package io.furrow.bench.ingest;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.Map;
import java.util.Properties;
import java.util.function.IntConsumer;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.bench.frame.TopicFiller;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/** Generates the records of the input topic: reports of thermometers through an IoT Agent, as the NGSI source writes them. */
final class ReportedEntities {
    /** The domain of all of them. */
    static final String DOMAIN = "bench";

    private static final FiwareScope SCOPE = new FiwareScope("farm", "/");
    private static final Duration DELAY = Duration.ofMillis(7);
    private static final int RECORDS_PER_LINE = 100_000;

    private final IngestReport.Plan plan;
    private final Instant first;

    ReportedEntities(IngestReport.Plan plan) {
        this.plan = plan;
        this.first = Instant.now().minusSeconds(plan.records() / plan.devices() + 1L);
    }

    static String mission(int number) {
        return "mission-" + number;
    }

    /** @param progress is called with the number written, now and then */
    void writeTo(String topic, Properties kafka, IntConsumer progress) throws UnreadableException {
        try (TopicFiller filler = new TopicFiller(kafka, Map.of("batch.size", "131072"))) {
            for (int number = 0; number < plan.records(); number++) {
                filler.send(record(topic, number));
                if (number % RECORDS_PER_LINE == RECORDS_PER_LINE - 1) {
                    progress.accept(number + 1);
                }
            }
        }
    }

    private ProducerRecord<byte[], byte[]> record(String topic, int number) throws UnreadableException {
        int device = number % plan.devices();
        Instant time = first.plusMillis(number * 1000L / plan.devices());
        Entity entity = Entity.parse(json(device, number, time).getBytes(StandardCharsets.UTF_8));
        EntityEvent event = EntityEvent.of(
                entity, SCOPE, time.plus(DELAY), EventTimeRule.within(Duration.ofMinutes(5)), Origin.NOTIFICATION);
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(
                topic, null, time.toEpochMilli(), entity.id().getBytes(StandardCharsets.UTF_8), entity.toBytes());
        event.headers("/ngsi-source/bench")
                .forEach((name, text) -> record.headers().add(name, text.getBytes(StandardCharsets.UTF_8)));
        return record;
    }

    /** Six measures, each with the time that the IoT Agent adds, and a text to reach the size. */
    private String json(int device, int number, Instant time) {
        String instant = "{\"TimeInstant\":{\"type\":\"DateTime\",\"value\":\"" + time + "\"}}";
        String json = """
                {"id":"urn:ngsi-ld:Thermometer:%05d","type":"Thermometer",\
                "Domain":{"type":"String","value":"%s","metadata":{}},\
                "Mission":{"type":"String","value":"%s","metadata":{}},\
                "Time":{"type":"Integer","value":%d,"metadata":{}},\
                "Temperature":{"type":"Float","value":%s,"metadata":@},\
                "Latitude":{"type":"Float","value":40.31%04d,"metadata":@},\
                "Longitude":{"type":"Float","value":-3.48%04d,"metadata":@},\
                "Status":{"type":"Boolean","value":true,"metadata":@},\
                "Battery":{"type":"Float","value":0.%02d,"metadata":@},\
                "Location":{"type":"String","value":"#","metadata":{}}}""".formatted(
                        device,
                        DOMAIN,
                        mission(device % plan.missions()),
                        time.toEpochMilli(),
                        15 + number % 200 / 10.0,
                        number % 10_000,
                        device % 10_000,
                        99 - number % 50)
                .replace("@", instant);
        return json.replace("#", "x".repeat(Math.max(0, plan.bytes() + 1 - json.length())));
    }
}
