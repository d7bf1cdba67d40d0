package io.furrow.flink.job;

import java.time.DateTimeException;
import java.time.Instant;
import java.util.Locale;
import java.util.Optional;

import picocli.CommandLine.TypeConversionException;

/**
 * The position at which a job without a savepoint or checkpoint begins to read. Holds no Flink type, like
 * {@link JobOptions}.
 *
 * @param time if the kind is {@link Kind#TIME}, else empty
 */
public record StartPosition(Kind kind, Optional<Instant> time) {
    /** The kind of position. */
    public enum Kind {
        /** The committed offset of the consumer group, else the beginning. */
        COMMITTED,
        EARLIEST,
        LATEST,
        /** The first record whose timestamp is not before a time. */
        TIME
    }

    /** @throws TypeConversionException if the text is not a position */
    static StartPosition of(String text) {
        return switch (text.toLowerCase(Locale.ROOT)) {
            case "committed" -> new StartPosition(Kind.COMMITTED, Optional.empty());
            case "earliest" -> new StartPosition(Kind.EARLIEST, Optional.empty());
            case "latest" -> new StartPosition(Kind.LATEST, Optional.empty());
            default -> new StartPosition(Kind.TIME, Optional.of(time(text)));
        };
    }

    private static Instant time(String text) {
        try {
            Instant time = Instant.parse(text);
            if (time.isBefore(Instant.EPOCH)) {
                throw new TypeConversionException("'" + text + "' is before 1970, where no record can be");
            }
            return time;
        } catch (DateTimeException e) {
            throw new TypeConversionException("'" + text
                    + "' is not a position; write committed, earliest, latest or a time as in 2026-05-01T06:00:00Z");
        }
    }
}
