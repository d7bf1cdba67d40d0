package io.furrow.model.event;

import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * References an original record in the headers of a record that represents it, so that late and dead records do not
 * copy large values.
 *
 * @param bytes of the original's value
 */
public record OriginalReference(String topic, int partition, long offset, long bytes) {
    /** {@code <topic>-<partition>@<offset>}. */
    public static final String POSITION = "original";

    public static final String BYTES = "original-bytes";
    public static final Set<String> HEADERS = Set.of(POSITION, BYTES);

    private static final Pattern PLACE = Pattern.compile("(.+)-(\\d{1,9})@(\\d{1,18})");
    private static final Pattern SIZE = Pattern.compile("\\d{1,18}");

    /** Parses two headers, each null if missing; empty if they are not a reference. */
    public static Optional<OriginalReference> of(String position, String bytes) {
        Matcher place = PLACE.matcher(position == null ? "" : position);
        if (!place.matches()) {
            return Optional.empty();
        }
        long size = bytes != null && SIZE.matcher(bytes).matches() ? Long.parseLong(bytes) : 0;
        return Optional.of(new OriginalReference(
                place.group(1), Integer.parseInt(place.group(2)), Long.parseLong(place.group(3)), size));
    }

    public Map<String, String> headers() {
        return Map.of(POSITION, topic + "-" + partition + "@" + offset, BYTES, Long.toString(bytes));
    }
}
