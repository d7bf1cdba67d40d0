package io.furrow.control.replay;

import java.nio.charset.StandardCharsets;
import java.util.Optional;
import java.util.Set;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.record.TimestampType;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class DeletedNamesTest {
    private final DeletedNames names = new DeletedNames();

    @Test
    void haveTheTopicsOfDeletedMissionsAndDomains() {
        take(Topics.DOMAINS, "north", "{}", 0);
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 0);
        take(Topics.MISSIONS, "weeding", null, 100);
        take(Topics.DOMAINS, "north", null, 200);

        assertThat(names.by(99)).isEmpty();
        assertThat(names.by(100)).containsExactly("data.north.realtime.weeding");
        assertThat(names.by(200)).containsExactlyInAnyOrder("data.north.realtime.weeding", "data.north.realtime");

        names.forget("data.north.realtime");
        assertThat(names.by(200)).containsExactly("data.north.realtime.weeding");
    }

    @Test
    void haveNoneOfAMissionThatWasMadeAnew() {
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 0);
        take(Topics.MISSIONS, "weeding", null, 100);
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 200);

        assertThat(names.by(1_000)).isEmpty();
        assertThat(names.lackDomains()).isFalse();
    }

    @Test
    void haveTheTopicsOfMissionsWhoseRecordIsCompactedAwayOrNotReadable() {
        take(Topics.DOMAINS, "north", "{}", 0);
        take(Topics.DOMAINS, "south", null, 0);
        take(Topics.MISSIONS, "mowing", null, 100);
        take(Topics.MISSIONS, "sowing", "no JSON", 0);
        take(Topics.MISSIONS, "sowing", null, 200);
        take(Topics.MISSIONS, "weeding", null, 100);
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 200);

        assertThat(names.lackDomains()).isTrue();
        names.find(Set.of(
                "data.south.realtime.mowing",
                "data.north.realtime.sowing",
                "data.north.realtime.weeding",
                "data.of-others.realtime.mowing"));

        assertThat(names.lackDomains()).isFalse();
        assertThat(names.by(100)).containsExactlyInAnyOrder("data.south.realtime", "data.south.realtime.mowing");
        assertThat(names.by(200)).contains("data.north.realtime.sowing").hasSize(3);
    }

    @Test
    void haveNoTopicOfAMissionThatMayBeOfEitherDomain() {
        take(Topics.DOMAINS, "north", "{}", 0);
        take(Topics.DOMAINS, "south", "{}", 0);
        take(Topics.MISSIONS, "run-1", null, 100);

        names.find(Set.of("data.north.realtime.run-1", "data.south.realtime.run-1"));

        assertThat(names.by(1_000)).isEmpty();
    }

    @Test
    void haveNoTopicOfAnotherDomainForAMissionThatWasMadeAnew() {
        take(Topics.DOMAINS, "north", "{}", 0);
        take(Topics.DOMAINS, "south", "{}", 0);
        take(Topics.MISSIONS, "weeding", null, 100);
        take(Topics.MISSIONS, "weeding", "{\"domain\":\"north\"}", 200);

        names.find(Set.of("data.south.realtime.weeding"));

        assertThat(names.by(1_000)).isEmpty();
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
                value == null ? null : value.getBytes(StandardCharsets.UTF_8),
                new RecordHeaders(),
                Optional.empty()));
    }
}
