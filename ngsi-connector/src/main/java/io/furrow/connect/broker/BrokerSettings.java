package io.furrow.connect.broker;

import java.net.URI;
import java.time.Duration;
import java.util.Map;
import java.util.Optional;
import javax.net.ssl.SSLContext;

import org.apache.kafka.common.config.types.Password;

import io.furrow.model.file.AccessToken;

/**
 * The connection to a context broker.
 *
 * @param base for instance {@code http://orion:1026}, with or without a path
 * @param timeout of one request, from its start to the end of its answer
 * @param headers sent with every request, for instance a token; their values appear nowhere else
 * @param token sent with every request, from a file
 * @param tls the trusted certificates; empty for those of the JVM
 * @param maxAnswerBytes maximum bytes of an answer's body; a larger one is dropped
 */
public record BrokerSettings(
        URI base,
        Duration timeout,
        Map<String, Password> headers,
        AccessToken token,
        Optional<SSLContext> tls,
        long maxAnswerBytes) {
    private static final long MAX_ANSWER_BYTES = 64L * 1024 * 1024;

    public BrokerSettings(URI base, Duration timeout, Map<String, Password> headers, Optional<SSLContext> tls) {
        this(base, timeout, headers, AccessToken.NONE, tls, MAX_ANSWER_BYTES);
    }

    public static BrokerSettings of(URI base, Duration timeout) {
        return new BrokerSettings(base, timeout, Map.of(), Optional.empty());
    }

    public BrokerSettings withMaxAnswerBytes(long bytes) {
        return new BrokerSettings(base, timeout, headers, token, tls, bytes);
    }

    BrokerSettings withToken(AccessToken other) {
        return new BrokerSettings(base, timeout, headers, other, tls, maxAnswerBytes);
    }

    /** The base without a slash at its end. */
    String prefix() {
        String text = base.toString();
        return text.endsWith("/") ? text.substring(0, text.length() - 1) : text;
    }
}
