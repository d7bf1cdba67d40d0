package io.furrow.bench.replay;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Instant;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.header.Header;

import io.furrow.flink.kafka.TopicRecordSchema;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.event.HeaderNames;
import io.furrow.replay.playback.PlaybackRecord;
import io.furrow.replay.record.EventEncoder;
import io.furrow.replay.record.ReplayRecords;

/**
 * An event on the topic of a replay whose records have the time of replay as their timestamp.
 *
 * @param sequence from 0 in the replay
 * @param time original event time, epoch ms
 * @param handedOver to the producer, epoch ms
 * @param appended by the broker, epoch ms
 */
record PlayedRecord(long sequence, long time, long handedOver, long appended) {
    private static final String EVENT = "event";
    private static final TopicRecordSchema FORMAT = new TopicRecordSchema();

    static boolean isEvent(ConsumerRecord<byte[], byte[]> record) {
        return header(record, HeaderNames.REPLAY_KIND).equals(EVENT);
    }

    /** @param record of a topic with timestamps set by the broker */
    static PlayedRecord of(ConsumerRecord<byte[], byte[]> record) {
        long time = Instant.parse(header(record, HeaderNames.REPLAY_TIME)).toEpochMilli();
        long offset = Long.parseLong(header(record, HeaderNames.REPLAY_OFFSET));
        long sequence = Long.parseLong(header(record, HeaderNames.REPLAY_SEQUENCE));
        return new PlayedRecord(sequence, time, time + offset, record.timestamp());
    }

    /** The record that a replay would write at this moment. @param encoder of the replay */
    static ProducerRecord<byte[], byte[]> written(
            StoredEvent event, DesiredReplay replay, EventEncoder encoder, long sequence, long now) {
        try {
            PlaybackRecord playbackRecord = new PlaybackRecord(
                    PlaybackRecord.Kind.EVENT,
                    encoder.event(event),
                    null,
                    0,
                    sequence,
                    event.time(),
                    now - event.time());
            return FORMAT.serialize(ReplayRecords.of(playbackRecord, replay), null, null);
        } catch (IOException | InterruptedException e) {
            throw new IllegalStateException("an event was not encoded", e);
        }
    }

    static EventEncoder encoder(DesiredReplay replay) {
        return new EventEncoder(replay, 0, record -> record);
    }

    private static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null ? "" : new String(header.value(), StandardCharsets.UTF_8);
    }
}
