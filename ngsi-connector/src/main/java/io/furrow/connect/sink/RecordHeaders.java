package io.furrow.connect.sink;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Date;
import java.util.OptionalLong;

import org.apache.kafka.connect.header.Header;
import org.apache.kafka.connect.sink.SinkRecord;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.time.Instants;

/**
 * Reads the headers of a record, whatever the worker's header converter made of their text: text, bytes, numbers or
 * dates.
 */
final class RecordHeaders {
    private RecordHeaders() {}

    /** The text of a header; {@code otherwise} if it is missing. */
    static String text(SinkRecord record, String name, String otherwise) {
        Object value = value(record, name);
        if (value == null) {
            return otherwise;
        }
        return value instanceof byte[] bytes ? new String(bytes, StandardCharsets.UTF_8) : value.toString();
    }

    /**
     * The text of a header that holds a name.
     *
     * @throws UnreadableException if the header is a number: 007 and 7 are two names and one number
     */
    static String name(SinkRecord record, String name, String otherwise) throws UnreadableException {
        if (value(record, name) instanceof Number number) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT,
                    "the header converter made the number " + number + " of the header " + name
                            + "; set header.converter=org.apache.kafka.connect.storage.StringConverter");
        }
        return text(record, name, otherwise);
    }

    /** Epoch milliseconds of a header that is a date, a number or text of them, or ISO 8601 (UTC without offset); else empty. */
    static OptionalLong millis(SinkRecord record, String name) {
        Object value = value(record, name);
        if (value instanceof Date date) {
            return OptionalLong.of(date.getTime());
        } else if (value instanceof Number number) {
            return OptionalLong.of(number.longValue());
        }
        return Instants.ofText(text(record, name, "")).stream()
                .mapToLong(Instant::toEpochMilli)
                .findFirst();
    }

    private static Object value(SinkRecord record, String name) {
        Header header = record.headers().lastWithName(name);
        return header == null ? null : header.value();
    }
}
