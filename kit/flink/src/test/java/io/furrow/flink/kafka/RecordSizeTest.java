package io.furrow.flink.kafka;

import java.util.Map;
import java.util.Properties;
import java.util.Random;

import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.common.compress.Compression;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.internals.RecordHeader;
import org.apache.kafka.common.record.AbstractRecords;
import org.apache.kafka.common.record.CompressionType;
import org.apache.kafka.common.record.RecordBatch;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.flink.record.TopicRecord;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class RecordSizeTest {
    private static final Compression NONE = Compression.of("none").build();

    @ParameterizedTest
    @ValueSource(ints = {0, 1, 63, 64, 8191, 8192, 1_048_576, 9_000_000})
    void isAtLeastWhatTheProducerAndTheBrokerCount(int bytes) {
        Map<String, String> headers = Map.of("plain", "text", "ñandú", "é€🚜", "empty", "");
        TopicRecord record = record(new byte[bytes], headers);

        assertThat(RecordSize.atMost(record))
                .isGreaterThanOrEqualTo(countedByTheProducer(record))
                .isGreaterThanOrEqualTo(RecordSize.atTheBroker(record, NONE))
                .isLessThan(RecordSize.atTheBroker(record, NONE) + 100);
    }

    @Test
    void takesTheEmptyRecordAndTheDeletion() {
        TopicRecord deletion = new TopicRecord("t", -1, -1, 0, null, null, Map.of());

        assertThat(RecordSize.atMost(deletion)).isGreaterThanOrEqualTo(countedByTheProducer(deletion));
    }

    @Test
    void isThatOfTheCompressedRecordAtTheBroker() {
        TopicRecord zeroes = record(new byte[100_000], Map.of());
        TopicRecord noise = record(random(100_000), Map.of());
        Compression zstd = Compression.of("zstd").build();

        assertThat(RecordSize.atTheBroker(zeroes, zstd)).isLessThan(1_000);
        assertThat(RecordSize.atTheBroker(noise, zstd)).isGreaterThan(100_000);
    }

    @Test
    void isLimitedByTheSmallerOfRequestAndBuffer() {
        Properties producer = new Properties();
        assertThat(SizeLimits.of(producer).ofProducer()).as("Kafka's default").isEqualTo(1024 * 1024);

        producer.setProperty(ProducerConfig.MAX_REQUEST_SIZE_CONFIG, "5000000");
        producer.setProperty(ProducerConfig.BUFFER_MEMORY_CONFIG, " 4000000 ");
        producer.setProperty(ProducerConfig.COMPRESSION_TYPE_CONFIG, "GZIP");
        assertThat(SizeLimits.of(producer).ofProducer()).isEqualTo(4_000_000);
        assertThat(SizeLimits.of(producer).compression().type()).isEqualTo(CompressionType.GZIP);
    }

    private static TopicRecord record(byte[] value, Map<String, String> headers) {
        return TopicRecord.of("t", 1_700_000_000_000L, "robot:ñ", value, headers);
    }

    private static byte[] random(int bytes) {
        byte[] noise = new byte[bytes];
        new Random(7).nextBytes(noise);
        return noise;
    }

    private static long countedByTheProducer(TopicRecord record) {
        Header[] headers = record.headers().entrySet().stream()
                .map(each -> new RecordHeader(each.getKey(), each.getValue().getBytes(UTF_8)))
                .toArray(Header[]::new);
        return AbstractRecords.estimateSizeInBytesUpperBound(
                RecordBatch.CURRENT_MAGIC_VALUE, CompressionType.NONE, record.key(), record.value(), headers);
    }
}
