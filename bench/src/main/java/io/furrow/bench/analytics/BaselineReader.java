package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.analytics.load.FleetTopic;
import io.furrow.bench.frame.TopicReader;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

/** Reads a topic with a consumer in one thread and passes the positions to a {@link BaselineLoop}, in the order of arrival. */
final class BaselineReader {
    private BaselineReader() {}

    static double perSecond(FleetTopic topic, int devices) throws UnreadableException {
        BaselineLoop loop = new BaselineLoop(devices);
        EntityReader entities = new EntityReader(Set.of());
        try (TopicReader reader = TopicReader.fromBeginning(topic.kafka(), Map.of(), topic.name())) {
            long begin = System.nanoTime();
            for (long read = 0; read < topic.sent(); ) {
                for (ConsumerRecord<byte[], byte[]> record : reader.poll(Duration.ofSeconds(1))) {
                    loop.take(fix(entities, record));
                    read++;
                }
            }
            return topic.sent() / ((System.nanoTime() - begin) / 1e9);
        }
    }

    private static PositionFix fix(EntityReader reader, ConsumerRecord<byte[], byte[]> record)
            throws UnreadableException {
        reader.read(record.value());
        if (!(reader.position() instanceof PositionReading.Located located)) {
            throw new IllegalStateException("a robot without a position at offset " + record.offset());
        }
        Position position = located.position();
        String identity = "farm|/|" + reader.id();
        return Fleet.fix(identity, reader.id(), position.latitude(), position.longitude(), record.timestamp());
    }
}
