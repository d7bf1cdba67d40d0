package io.furrow.connect.sink;

import java.time.DateTimeException;
import java.time.Instant;
import java.time.OffsetDateTime;
import java.util.OptionalLong;

import com.fasterxml.jackson.databind.JsonNode;

/** Times as context brokers write them. */
final class ReportedTimes {
    private ReportedTimes() {}

    /** Epoch milliseconds of an ISO 8601 date and time with offset, or of a number of them; empty where a long cannot hold them. */
    static OptionalLong millis(JsonNode time) {
        if (time.isNumber()) {
            return time.canConvertToLong() ? OptionalLong.of(time.longValue()) : OptionalLong.empty();
        }
        try {
            return time.isTextual()
                    ? OptionalLong.of(OffsetDateTime.parse(time.textValue().trim())
                            .toInstant()
                            .toEpochMilli())
                    : OptionalLong.empty();
        } catch (DateTimeException | ArithmeticException e) {
            return OptionalLong.empty();
        }
    }

    /** ISO 8601 in UTC. */
    static String text(long millis) {
        return Instant.ofEpochMilli(millis).toString();
    }
}
