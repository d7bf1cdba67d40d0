package io.furrow.flink.kafka;

import java.util.Locale;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.common.compress.Compression;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.record.CompressionType;

/**
 * The limits of record size.
 *
 * @param ofProducer bytes that the producer accepts, whatever the topic
 * @param compression of the producer, because a topic's limit is one of compressed bytes
 */
record SizeLimits(long ofProducer, Compression compression) {
    /** From the settings, else Kafka's defaults. */
    static SizeLimits of(Properties producer) {
        long request = number(producer, ProducerConfig.MAX_REQUEST_SIZE_CONFIG);
        long buffer = number(producer, ProducerConfig.BUFFER_MEMORY_CONFIG);
        String type = producer.getProperty(ProducerConfig.COMPRESSION_TYPE_CONFIG, CompressionType.NONE.name);
        return new SizeLimits(
                Math.min(request, buffer),
                Compression.of(type.trim().toLowerCase(Locale.ROOT)).build());
    }

    private static long number(Properties producer, String setting) {
        Map<String, ConfigDef.ConfigKey> known = ProducerConfig.configDef().configKeys();
        Object given = producer.getOrDefault(setting, known.get(setting).defaultValue);
        return Long.parseLong(given.toString().trim());
    }
}
