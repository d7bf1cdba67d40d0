package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.stream.IntStream;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.analytics.load.FleetTopic;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.position.PositionReading;

/** One thread that reads a topic with a consumer and gives the positions to a {@link BaselineLoop}, in the order of arrival. */
final class BaselineReader {
    private BaselineReader() {}

    static double perSecond(FleetTopic topic, int devices) throws UnreadableException {
        Properties properties = new Properties();
        properties.putAll(topic.kafka());
        BaselineLoop loop = new BaselineLoop(devices);
        EntityReader reader = new EntityReader(Set.of());
        try (var consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            List<TopicPartition> partitions = IntStream.range(0, topic.partitions())
                    .mapToObj(partition -> new TopicPartition(topic.name(), partition))
                    .toList();
            consumer.assign(partitions);
            consumer.seekToBeginning(partitions);
            long begin = System.nanoTime();
            for (long read = 0; read < topic.sent(); ) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofSeconds(1))) {
                    loop.take(fix(reader, record));
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
        return Fleet.fix(
                "farm|/|" + reader.id(),
                reader.id(),
                located.position().latitude(),
                located.position().longitude(),
                record.timestamp());
    }
}
