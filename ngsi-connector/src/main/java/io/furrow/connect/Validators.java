package io.furrow.connect;

import java.net.URI;
import java.util.List;
import java.util.function.Consumer;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.types.Password;

/** Validators of options; each message names the option, its value and the expected values. */
public final class Validators {
    private static final String TOPIC = "[A-Za-z0-9._-]{1,249}";
    private static final String HTTP_URL = "http://HOST:PORT or https://HOST:PORT";

    private Validators() {}

    /** The name of a Kafka topic. */
    public static Validator topic() {
        return matching(TOPIC, "1 to 249 of A-Z a-z 0-9 . _ -");
    }

    /** The name of a Kafka topic, or nothing. */
    public static Validator optionalTopic() {
        return matching(TOPIC + "|", "empty, or 1 to 249 of A-Z a-z 0-9 . _ -");
    }

    /** A list of regular expressions. */
    public static Validator patterns() {
        return each(Validators::requirePattern, "regular expressions");
    }

    /** A regular expression, or nothing. */
    public static Validator pattern() {
        return one(Validators::requirePattern, "a regular expression");
    }

    /** The base URL of an HTTP server. */
    public static Validator httpUrl() {
        return one(Validators::requireHttpUrl, HTTP_URL);
    }

    /** The base URL of an HTTP server, or nothing. */
    public static Validator optionalHttpUrl() {
        return one(
                (String url) -> {
                    if (!"".equals(url)) {
                        requireHttpUrl(url);
                    }
                },
                "empty, http://HOST:PORT or https://HOST:PORT");
    }

    /** A secret that a header can carry: visible ASCII and spaces, or nothing. */
    public static Validator headerSecret() {
        return one(
                (Password secret) ->
                        require(secret.value().matches("[ -~]*"), "expected visible ASCII and spaces only"),
                "visible ASCII and spaces");
    }

    /** Text that matches as a whole. */
    public static Validator matching(String pattern, String expected) {
        return one(match(pattern, expected), expected);
    }

    /** A list of texts that match as a whole. */
    public static Validator names(String pattern, String expected) {
        return each(match(pattern, expected), expected);
    }

    /** Accepts any value that the type of the option allows. */
    public static Validator any(String expected) {
        return LambdaValidator.with((name, value) -> {}, () -> expected);
    }

    /** A value that a check accepts, which throws {@link IllegalArgumentException} for others. */
    public static <T> Validator one(Consumer<T> check, String expected) {
        return LambdaValidator.with((name, value) -> check(name, value, check), () -> expected);
    }

    /** A list of values that a check accepts, which throws {@link IllegalArgumentException} for others. */
    public static Validator each(Consumer<String> check, String expected) {
        return LambdaValidator.with(
                (name, value) -> ((List<?>) value).forEach(one -> check(name, one, check)), () -> expected);
    }

    @SuppressWarnings("unchecked")
    private static <T> void check(String name, Object value, Consumer<T> check) {
        try {
            check.accept((T) value);
        } catch (IllegalArgumentException e) {
            throw new ConfigException(name, value, e.getMessage());
        }
    }

    /** @throws IllegalArgumentException if a condition of a check is not met */
    public static void require(boolean isMet, String message) {
        if (!isMet) {
            throw new IllegalArgumentException(message);
        }
    }

    private static Consumer<String> match(String pattern, String expected) {
        Pattern compiled = Pattern.compile(pattern);
        return text -> require(text != null && compiled.matcher(text).matches(), "expected " + expected);
    }

    private static void requirePattern(String pattern) {
        try {
            Pattern.compile(pattern);
        } catch (PatternSyntaxException e) {
            throw new IllegalArgumentException("no regular expression: " + e.getMessage(), e);
        }
    }

    private static void requireHttpUrl(String url) {
        URI uri;
        try {
            uri = URI.create(String.valueOf(url));
        } catch (IllegalArgumentException e) {
            throw new IllegalArgumentException("no URL: " + e.getMessage(), e);
        }
        boolean http = "http".equalsIgnoreCase(uri.getScheme()) || "https".equalsIgnoreCase(uri.getScheme());
        require(
                http && uri.getHost() != null && uri.getRawQuery() == null && uri.getRawFragment() == null,
                "expected " + HTTP_URL);
    }
}
