package io.furrow.control.replay;

import java.util.Optional;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.record.TimestampType;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class DeletedNamesTest {
    private final DeletedNames names = new DeletedNames();

    @Test
    void containsTopicsOfDeletedMissionsAndDomains() {
        take(Topics.DOMAINS, "north", "{}", 0);
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 0);
        take(Topics.MISSIONS, "weeding", null, 100);
        take(Topics.DOMAINS, "north", null, 200);

        assertThat(names.deletedBy(99)).isEmpty();
        assertThat(names.deletedBy(100)).containsExactly("data.north.realtime.weeding");
        assertThat(names.deletedBy(200))
                .containsExactlyInAnyOrder("data.north.realtime.weeding", "data.north.realtime");

        names.forget("data.north.realtime");
        assertThat(names.deletedBy(200)).containsExactly("data.north.realtime.weeding");
    }

    @Test
    void excludesARecreatedMission() {
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 0);
        take(Topics.MISSIONS, "weeding", null, 100);
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 200);

        assertThat(names.deletedBy(1_000)).isEmpty();
    }

    /** A topic with that name in another domain may belong to devices that report the mission themselves. */
    @Test
    void excludesAMissionWithoutAReadableRecord() {
        take(Topics.DOMAINS, "north", "{}", 0);
        take(Topics.MISSIONS, "mowing", null, 100);
        take(Topics.MISSIONS, "sowing", "no JSON", 0);
        take(Topics.MISSIONS, "sowing", null, 200);

        assertThat(names.deletedBy(1_000)).isEmpty();
    }

    private void take(String topic, String key, String value, long timestamp) {
        names.take(new ConsumerRecord<>(
                topic,
                0,
                0,
                timestamp,
                TimestampType.CREATE_TIME,
                0,
                0,
                key,
                value == null ? null : value.getBytes(UTF_8),
                new RecordHeaders(),
                Optional.empty()));
    }
}
