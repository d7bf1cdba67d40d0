package io.furrow.connect;

import java.net.URI;
import java.util.List;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.types.Password;

/** Validators of options; each message names the option, its value and the expected values. */
public final class Validators {
    private static final Pattern TOPIC = Pattern.compile("[A-Za-z0-9._-]{1,249}");

    private Validators() {}

    /** The name of a Kafka topic. */
    public static Validator topic() {
        return matching(TOPIC, "1 to 249 of A-Z a-z 0-9 . _ -");
    }

    /** The name of a Kafka topic, or nothing. */
    public static Validator optionalTopic() {
        return matching(Pattern.compile(TOPIC.pattern() + "|"), "empty, or 1 to 249 of A-Z a-z 0-9 . _ -");
    }

    /** A list of regular expressions. */
    public static Validator patterns() {
        return LambdaValidator.with(Validators::requirePatterns, () -> "regular expressions");
    }

    /** A regular expression, or nothing. */
    public static Validator pattern() {
        return LambdaValidator.with(
                (name, value) -> requirePatterns(name, List.of(value)), () -> "a regular expression");
    }

    /** A list of texts that match as a whole. */
    public static Validator names(Pattern pattern, String expected) {
        return LambdaValidator.with(
                (name, value) -> {
                    for (Object one : (List<?>) value) {
                        if (!pattern.matcher((String) one).matches()) {
                            throw new ConfigException(name, one, "expected " + expected);
                        }
                    }
                },
                () -> expected);
    }

    /** The base URL of an HTTP server. */
    public static Validator httpUrl() {
        return LambdaValidator.with(Validators::requireHttpUrl, () -> "http://HOST:PORT or https://HOST:PORT");
    }

    /** The base URL of an HTTP server, or nothing. */
    public static Validator optionalHttpUrl() {
        return LambdaValidator.with(
                (name, value) -> {
                    if (!"".equals(value)) {
                        requireHttpUrl(name, value);
                    }
                },
                () -> "empty, http://HOST:PORT or https://HOST:PORT");
    }

    /** True or false, which the type already validates. */
    public static Validator truth() {
        return LambdaValidator.with((name, value) -> {}, () -> "true or false");
    }

    /** A secret, any text. */
    public static Validator secret() {
        return LambdaValidator.with((name, value) -> {}, () -> "any text");
    }

    /** A secret that a header can carry: visible ASCII and spaces, or nothing. */
    public static Validator headerSecret() {
        return LambdaValidator.with(
                (name, value) -> {
                    if (!((Password) value).value().matches("[ -~]*")) {
                        throw new ConfigException(name, value, "expected visible ASCII and spaces only");
                    }
                },
                () -> "visible ASCII and spaces");
    }

    /** Text that matches as a whole. */
    public static Validator matching(Pattern pattern, String expected) {
        return LambdaValidator.with(
                (name, value) -> {
                    if (value == null || !pattern.matcher((String) value).matches()) {
                        throw new ConfigException(name, value, "expected " + expected);
                    }
                },
                () -> expected);
    }

    private static void requirePatterns(String name, Object value) {
        for (Object pattern : (List<?>) value) {
            try {
                Pattern.compile((String) pattern);
            } catch (PatternSyntaxException e) {
                throw new ConfigException(name, pattern, "no regular expression: " + e.getMessage());
            }
        }
    }

    private static void requireHttpUrl(String name, Object value) {
        try {
            URI uri = URI.create(String.valueOf(value));
            boolean http = "http".equalsIgnoreCase(uri.getScheme()) || "https".equalsIgnoreCase(uri.getScheme());
            if (!http || uri.getHost() == null || uri.getRawQuery() != null || uri.getRawFragment() != null) {
                throw new ConfigException(name, value, "expected http://HOST:PORT or https://HOST:PORT");
            }
        } catch (IllegalArgumentException e) {
            throw new ConfigException(name, value, "no URL: " + e.getMessage());
        }
    }
}
