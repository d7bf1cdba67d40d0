package io.furrow.mission.marker;

import java.nio.charset.StandardCharsets;
import java.time.Instant;

/** Validates markers. */
final class MarkerRules {
    static final int MAX_NOTE_LENGTH = 1_000;

    private static final int MAX_AUTHOR_LENGTH = 200;
    private static final int MAX_ID_LENGTH = 100;
    private static final long LATEST = Instant.parse("9999-12-31T23:59:59.999Z").toEpochMilli();

    private MarkerRules() {}

    static void check(Marker marker) throws RejectedMarkerException {
        text(marker.id(), "id", MAX_ID_LENGTH, "write a shorter one, for instance a UUID");
        text(marker.mission(), "mission", Integer.MAX_VALUE, "write the name of a mission");
        text(marker.note(), "note", MAX_NOTE_LENGTH, "write what is to be seen at that moment, in fewer words");
        if (marker.author() == null || !marker.author().isEmpty()) {
            text(marker.author(), "author", MAX_AUTHOR_LENGTH, "write a shorter name, or an empty one");
        }
        time(marker.time(), "time");
        time(marker.created(), "created");
    }

    private static void text(String text, String name, int maxLength, String remedy) throws RejectedMarkerException {
        if (text == null || text.isBlank()) {
            throw new RejectedMarkerException("The %s of the marker is missing or blank; %s".formatted(name, remedy));
        }
        int length = text.codePointCount(0, text.length());
        if (length > maxLength) {
            throw new RejectedMarkerException("The %s of the marker has %,d characters, at most %,d are stored; %s"
                    .formatted(name, length, maxLength, remedy));
        }
        if (text.codePoints().anyMatch(codePoint -> Character.isISOControl(codePoint) && codePoint != '\n')) {
            throw new RejectedMarkerException(
                    "The %s of the marker holds control characters; write plain text".formatted(name));
        }
        if (!StandardCharsets.UTF_8.newEncoder().canEncode(text)) {
            throw new RejectedMarkerException(
                    "The %s of the marker holds half a character (a lone surrogate); leave it out".formatted(name));
        }
    }

    private static void time(long time, String name) throws RejectedMarkerException {
        if (time < 0 || time > LATEST) {
            throw new RejectedMarkerException(
                    "The %s %d of the marker is not between 1970 and 9999; write milliseconds since 1970"
                            .formatted(name, time));
        }
    }
}
