package io.furrow.dashboard.proxy;

import java.util.Locale;
import java.util.regex.Pattern;

import jakarta.servlet.http.HttpServletRequest;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.topic.TopicRules;

/**
 * A client's request for a stream.
 *
 * @param mode which records are sent to a slow client
 * @param prime whether the initial state is sent first
 * @param format of text frames
 */
record StreamRequest(String topic, Mode mode, boolean prime, Format format) {
    private static final Pattern TOPIC = Pattern.compile("[A-Za-z0-9._-]{1,249}");

    enum Mode {
        /** Every record is sent; a stream that is too slow is closed. */
        ALL,
        /** A newer record replaces a waiting one with the same key. */
        LATEST
    }

    enum Format {
        /** A frame is the value of a record. */
        VALUE,
        /** A frame holds records with key, time and headers. */
        RECORD
    }

    /** @throws Problem 400 for an invalid parameter, 403 for a topic that may not be read */
    static StreamRequest read(HttpServletRequest request, TopicRules rules, Format defaultValue) {
        String topic = topic(request, rules);
        return new StreamRequest(
                topic,
                choice(request, "mode", Mode.ALL),
                flag(request, "prime"),
                choice(request, "format", defaultValue));
    }

    /**
     * A numeric parameter.
     *
     * @param defaultValue null if the parameter is required
     */
    static long number(HttpServletRequest request, String name, long minimum, long maximum, Long defaultValue) {
        String value = request.getParameter(name);
        if (value == null && defaultValue != null) {
            return defaultValue;
        }
        try {
            long number = Long.parseLong(value);
            if (number >= minimum && number <= maximum) {
                return number;
            }
        } catch (NumberFormatException e) {
            // rejected like a number out of range
        }
        throw new Problem(
                400, "wrong-parameter", "'%s' must be a whole number from %d to %d".formatted(name, minimum, maximum));
    }

    /**
     * The topic at the end of the path. @throws Problem 400 for an invalid name, 403 for a topic that may not be read
     */
    static String topic(HttpServletRequest request, TopicRules rules) {
        String path = request.getPathInfo();
        String topic = path == null ? "" : path.substring(1);
        if (!TOPIC.matcher(topic).matches()) {
            throw new Problem(400, "illegal-topic", "the path does not end with the name of a topic");
        }
        if (!rules.mayRead(topic)) {
            throw new Problem(
                    403,
                    "topic-not-allowed",
                    "topic '%s' may not be read; --readable-topics lists the readable topics".formatted(topic));
        }
        return topic;
    }

    private static <E extends Enum<E>> E choice(HttpServletRequest request, String name, E defaultValue) {
        String value = request.getParameter(name);
        if (value == null) {
            return defaultValue;
        }
        for (E each : defaultValue.getDeclaringClass().getEnumConstants()) {
            if (each.name().toLowerCase(Locale.ROOT).equals(value)) {
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
                                        java.util.stream.Stream.of(defaultValue
                                                        .getDeclaringClass()
                                                        .getEnumConstants())
                                                .map(each -> each.name().toLowerCase(Locale.ROOT))
                                                .toList())));
    }

    private static boolean flag(HttpServletRequest request, String name) {
        String value = request.getParameter(name);
        if (value == null || value.equals("false")) {
            return false;
        } else if (value.equals("true")) {
            return true;
        }
        throw new Problem(400, "wrong-parameter", "'" + name + "' must be true or false");
    }
}
