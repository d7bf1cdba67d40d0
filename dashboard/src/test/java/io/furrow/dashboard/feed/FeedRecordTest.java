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

    @Test
    void hasAKeyOfItsIdIfTheRecordHasThatOfOtherEntities() {
        String pair = "'Device1_ID':{'value':'a'},'Device2_ID':{'value':'b'}";
        String encounter = key("{'id':'Analytics:Collision:1','type':'Analytics:Collision'}");

        assertThat(encounter)
                .isEqualTo(key("{'type':'Analytics:Collision','id':'Analytics:Collision:1'," + pair + "}"))
                .as("encounter of another tenant's device")
                .isNotEqualTo(key("{'id':'Analytics:Collision:2','type':'Analytics:Collision'}"))
                .as("prediction of the same pair")
                .isNotEqualTo(key("{'id':'Analytics:Collision:1:predicted','type':'Analytics:Collision'}"));
    }

    private static String key(String json) {
        byte[] value = json.replace('\'', '"').getBytes(UTF_8);
        ConsumerRecord<byte[], byte[]> record = new ConsumerRecord<>("t", 0, 0, "c".getBytes(UTF_8), value);
        return new FeedRecord(record, FeedRecord.NO_SEQUENCE, 1_000).key();
    }
}
