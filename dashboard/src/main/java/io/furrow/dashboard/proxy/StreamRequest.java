package io.furrow.dashboard.proxy;

import java.util.Locale;
import java.util.regex.Pattern;

import jakarta.servlet.http.HttpServletRequest;

import io.furrow.dashboard.feed.TopicRules;
import io.furrow.dashboard.http.Problem;

/**
 * What a client wants of a topic.
 *
 * @param mode what becomes of records that wait
 * @param prime whether the known state comes first
 * @param format of text frames
 */
record StreamRequest(String topic, Mode mode, boolean prime, Format format) {
    private static final Pattern TOPIC = Pattern.compile("[A-Za-z0-9._-]{1,249}");

    enum Mode {
        /** Every record; a stream that is too slow for that is closed. */
        ALL,
        /** The newest of each key takes the place of older ones that still wait. */
        LATEST
    }

    enum Format {
        /** A frame is the value of a record. */
        VALUE,
        /** A frame holds records with all that belongs to them. */
        RECORD
    }

    /** @throws Problem 400 for a parameter that is none, 403 for a topic that may not be read */
    static StreamRequest read(HttpServletRequest request, TopicRules rules, Format otherwise) {
        String topic = topic(request, rules);
        return new StreamRequest(
                topic, choice(request, "mode", Mode.ALL), flag(request, "prime"), choice(request, "format", otherwise));
    }

    /**
     * A parameter in its range.
     *
     * @param otherwise null if it must be said
     */
    static long number(HttpServletRequest request, String name, long minimum, long maximum, Long otherwise) {
        String given = request.getParameter(name);
        if (given == null && otherwise != null) {
            return otherwise;
        }
        try {
            long number = Long.parseLong(given);
            if (number >= minimum && number <= maximum) {
                return number;
            }
        } catch (NumberFormatException e) {
            // as of a number that is too large
        }
        throw new Problem(
                400, "wrong-parameter", "'%s' must be a whole number from %d to %d".formatted(name, minimum, maximum));
    }

    /** The topic that the path ends with. @throws Problem 400 for a name that is none, 403 for a topic that may not be read */
    static String topic(HttpServletRequest request, TopicRules rules) {
        String path = request.getPathInfo();
        String topic = path == null ? "" : path.substring(1);
        if (!TOPIC.matcher(topic).matches()) {
            throw new Problem(400, "illegal-topic", "the path ends with no name of a topic");
        }
        if (!rules.mayRead(topic)) {
            throw new Problem(
                    403,
                    "topic-not-allowed",
                    "topic '%s' is not among those that may be read; --readable-topics names them".formatted(topic));
        }
        return topic;
    }

    private static <E extends Enum<E>> E choice(HttpServletRequest request, String name, E otherwise) {
        String given = request.getParameter(name);
        if (given == null) {
            return otherwise;
        }
        for (E each : otherwise.getDeclaringClass().getEnumConstants()) {
            if (each.name().toLowerCase(Locale.ROOT).equals(given)) {
                return each;
            }
        }
        throw new Problem(
                400,
                "wrong-parameter",
                "'%s' must be one of %s"
                        .formatted(
                                name,
                                String.join(
                                        ", ",
                                        java.util.stream.Stream.of(otherwise
                                                        .getDeclaringClass()
                                                        .getEnumConstants())
                                                .map(each -> each.name().toLowerCase(Locale.ROOT))
                                                .toList())));
    }

    private static boolean flag(HttpServletRequest request, String name) {
        String given = request.getParameter(name);
        if (given == null || given.equals("false")) {
            return false;
        } else if (given.equals("true")) {
            return true;
        }
        throw new Problem(400, "wrong-parameter", "'" + name + "' must be true or false");
    }
}
