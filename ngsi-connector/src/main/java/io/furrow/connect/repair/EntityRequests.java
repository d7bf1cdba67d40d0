package io.furrow.connect.repair;

import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.List;
import java.util.Set;

import io.furrow.connect.subscription.Subject;

/**
 * Builds the paths of {@code GET /v2/entities}. All of them request only entities that the context broker stores itself
 * ({@code skipForwarding}): otherwise it would query an agent behind it for its registered attributes, for each page.
 */
final class EntityRequests {
    private static final String START = "/v2/entities?options=skipForwarding";

    private EntityRequests() {}

    /** The requested attributes and metadata; without names of metadata, all custom ones. */
    record NotifiedAttributes(Set<String> attrs, List<String> metadata) {
        private String query() {
            return "&attrs=" + encoded(String.join(",", attrs))
                    + (metadata.isEmpty() ? "" : "&metadata=" + encoded(String.join(",", metadata)));
        }
    }

    /**
     * @param order {@code dateModified} or {@code dateCreated}
     * @param from the least value of it
     */
    record Range(String order, Instant from, int offset, int limit) {
        Range first(int fewer) {
            return new Range(order, from, offset, fewer);
        }
    }

    /** A page of a subject's entities, oldest first. */
    static String page(Range range, Subject subject, NotifiedAttributes notifiedAttributes) {
        StringBuilder path = new StringBuilder(START)
                .append("&orderBy=")
                .append(range.order())
                .append(",id&q=")
                .append(encoded(range.order() + ">=" + range.from().truncatedTo(ChronoUnit.MILLIS)))
                .append("&limit=")
                .append(range.limit())
                .append(notifiedAttributes.query());
        if (range.offset() > 0) {
            path.append("&offset=").append(range.offset());
        }
        if (!subject.idPattern().equals(".*")) {
            path.append("&idPattern=").append(encoded(subject.idPattern()));
        }
        if (!subject.types().isEmpty()) {
            path.append("&type=").append(encoded(String.join(",", subject.types())));
        }
        subject.typePattern().ifPresent(pattern -> path.append("&typePattern=").append(encoded(pattern)));
        return path.toString();
    }

    /** The entities of an id, whatever their types. */
    static String ofId(String id, NotifiedAttributes notifiedAttributes) {
        // In a list of ids the comma is the separator.
        String which = id.contains(",") ? "&idPattern=" + encoded("^" + literal(id) + "$") : "&id=" + encoded(id);
        return START + which + "&limit=100" + notifiedAttributes.query();
    }

    /** An entity of an id and a type. */
    static String ofType(String id, String type, NotifiedAttributes notifiedAttributes) {
        return ofId(id, notifiedAttributes) + "&type=" + encoded(type);
    }

    private static String literal(String text) {
        StringBuilder pattern = new StringBuilder();
        text.codePoints().forEach(sign -> {
            if (sign < 128 && !Character.isLetterOrDigit(sign)) {
                pattern.append('\\');
            }
            pattern.appendCodePoint(sign);
        });
        return pattern.toString();
    }

    private static String encoded(String text) {
        return URLEncoder.encode(text, StandardCharsets.UTF_8).replace("+", "%20");
    }
}
