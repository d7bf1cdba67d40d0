package io.furrow.dashboard.feed;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class FeedRecordTest {
    @Test
    void hasAKeyOfIdAndType() {
        assertThat(key("{'id':'c','type':'Camera'}"))
                .isEqualTo(key("{'entity':'c','type':'Camera','url':'file:/a'}"))
                .isNotEqualTo(key("{'entity':'c','type':'Station','url':'file:/a'}"))
                .isNotEqualTo(key("{'entity':'c','url':'file:/a'}"));
        assertThat(key("{'type':'request'}")).isEqualTo(key("{'type':'response'}"));
    }

    private static String key(String json) {
        byte[] value = json.replace('\'', '"').getBytes(UTF_8);
        ConsumerRecord<byte[], byte[]> record = new ConsumerRecord<>("t", 0, 0, "c".getBytes(UTF_8), value);
        return new FeedRecord(record, FeedRecord.NO_SEQUENCE, 1_000).key();
    }
}
