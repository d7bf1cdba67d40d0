package io.furrow.bench.replay;

import java.nio.charset.StandardCharsets;
import java.time.Instant;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.internals.RecordHeaders;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.replay.WantedReplay;
import io.furrow.model.event.HeaderNames;
import io.furrow.replay.ReplayRecords;
import io.furrow.replay.playback.Played;

/**
 * An event on the topic of a replay whose records are stamped with the time at which they are played.
 *
 * @param sequence from 0 in the replay
 * @param time original event time, epoch ms
 * @param handedOver to the producer, epoch ms
 * @param appended by the broker, epoch ms
 */
record PlayedRecord(long sequence, long time, long handedOver, long appended) {
    private static final String EVENT = "event";

    static boolean isEvent(ConsumerRecord<byte[], byte[]> record) {
        return header(record, HeaderNames.REPLAY_KIND).equals(EVENT);
    }

    /** @param record of a topic whose timestamps are those of the broker */
    static PlayedRecord of(ConsumerRecord<byte[], byte[]> record) {
        long time = Instant.parse(header(record, HeaderNames.REPLAY_TIME)).toEpochMilli();
        long offset = Long.parseLong(header(record, HeaderNames.REPLAY_OFFSET));
        long sequence = Long.parseLong(header(record, HeaderNames.REPLAY_SEQUENCE));
        return new PlayedRecord(sequence, time, time + offset, record.timestamp());
    }

    /** The record that a replay would write at this moment. */
    static ProducerRecord<byte[], byte[]> written(StoredEvent event, WantedReplay replay, long sequence, long now) {
        Played played = new Played(Played.Kind.EVENT, event, null, 0, sequence, event.time(), now - event.time());
        TopicRecord record = ReplayRecords.of(played, replay);
        RecordHeaders headers = new RecordHeaders();
        record.headers().forEach((name, text) -> headers.add(name, text.getBytes(StandardCharsets.UTF_8)));
        return new ProducerRecord<>(record.topic(), null, record.timestamp(), record.key(), record.value(), headers);
    }

    private static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null ? "" : new String(header.value(), StandardCharsets.UTF_8);
    }
}
