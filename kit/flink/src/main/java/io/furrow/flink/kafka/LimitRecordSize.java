package io.furrow.flink.kafka;

import java.io.IOException;
import java.util.Arrays;
import java.util.Collection;
import java.util.HashMap;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

/**
 * Converts a record into one that Kafka accepts: the record itself, or, if it is too large, its dead letter on
 * {@code <topic>.dead}. A dead letter that is itself too large is truncated and marked; if that does not suffice, it loses
 * its own headers and its key. Topics are created when needed.
 */
public final class LimitRecordSize implements AutoCloseable {
    private static final String STAGE = "kafka";
    private static final long FITS = -1;

    private final OutputTopics topics;
    private final SizeLimits limits;

    LimitRecordSize(OutputTopics topics, SizeLimits limits) {
        this.topics = topics;
        this.limits = limits;
    }

    /**
     * Creates the topic if it is missing; {@link #of(TopicRecord)} then does not wait for that. Thread-safe.
     *
     * @return its partitions
     * @throws IOException if it cannot be created or described; the message says what to do
     */
    public int prepare(String topic) throws IOException, InterruptedException {
        return topics.partitions(topic);
    }

    /**
     * The broker's ids of the existing topics: a recreated topic has another. Thread-safe.
     *
     * @throws IOException if the broker does not answer
     */
    public Map<String, String> ids(Collection<String> names) throws IOException, InterruptedException {
        return topics.ids(names);
    }

    /**
     * @throws IOException if a topic cannot be created, or does not even accept a dead letter without its value; the message
     *     says what to do
     */
    public TopicRecord of(TopicRecord record) throws IOException, InterruptedException {
        long most = room(record);
        if (most == FITS) {
            return record;
        }
        if (Topics.ofDeadLetters(record.topic()).isPresent()) {
            return shortened(record, most);
        }
        TopicRecord letter = letter(record, most);
        long left = room(letter);
        return left == FITS ? letter : shortened(letter, left);
    }

    /** The size limit, if the record exceeds it; {@link #FITS} otherwise. */
    private long room(TopicRecord record) throws IOException, InterruptedException {
        long bytes = RecordSize.atMost(record);
        long most = Math.min(limits.ofProducer(), topics.limit(record.topic()));
        if (bytes <= most) {
            return FITS;
        }
        if (bytes <= limits.ofProducer()) {
            long compressed = RecordSize.atTheBroker(record, limits.compression());
            if (compressed <= most || compressed <= topics.limitAskedAnew(record.topic())) {
                return FITS;
            }
        }
        return most;
    }

    private static TopicRecord letter(TopicRecord record, long most) {
        String event = record.headers().get(HeaderNames.CE_ID);
        String message = "%s takes records of at most %d bytes, with key and headers this has up to %d%s"
                .formatted(record.topic(), most, RecordSize.atMost(record), event == null ? "" : "; event " + event);
        String source = record.headers().getOrDefault(HeaderNames.CE_SOURCE, record.topic());
        DeadLetter letter = new DeadLetter(Reason.TOO_LARGE, message, STAGE, source);
        return record.to(Topics.dead(record.topic())).with(letter.headers());
    }

    private TopicRecord shortened(TopicRecord letter, long most) throws IOException {
        int length = letter.value() == null ? 0 : letter.value().length;
        TopicRecord empty = truncated(letter, letter.key(), letter.headers(), 0);
        if (RecordSize.atMost(empty) > most) {
            empty = truncated(letter, null, reasons(letter), 0);
            if (RecordSize.atMost(empty) > most) {
                throw new IOException(
                        "topic %s takes records of at most %d bytes, not even the reason of a dead letter; raise its max.message.bytes"
                                .formatted(letter.topic(), most));
            }
            return empty;
        }
        int digits = Integer.toString(length).length(); // more than the 0 of the empty one
        long room = Math.max(0, most - RecordSize.atMost(empty) - digits);
        return truncated(letter, letter.key(), letter.headers(), (int) Math.min(length, room));
    }

    private static TopicRecord truncated(TopicRecord letter, byte[] key, Map<String, String> headers, int kept) {
        byte[] value = letter.value();
        Map<String, String> all = new HashMap<>(headers);
        all.merge(
                DeadLetter.MESSAGE,
                " (truncated to %d of %d bytes)".formatted(kept, value == null ? 0 : value.length),
                (message, said) -> message + said);
        return new TopicRecord(
                letter.topic(),
                letter.partition(),
                letter.offset(),
                letter.timestamp(),
                key,
                value == null ? null : Arrays.copyOf(value, kept),
                all);
    }

    private static Map<String, String> reasons(TopicRecord letter) {
        Map<String, String> reasons = new HashMap<>(letter.headers());
        reasons.keySet()
                .removeIf(name -> !DeadLetter.HEADERS.contains(name) && !OriginalReference.HEADERS.contains(name));
        return reasons;
    }

    @Override
    public void close() {
        topics.close();
    }
}
