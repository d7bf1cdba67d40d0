package io.furrow.connect.source.http;

import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.UnaryOperator;

import org.apache.kafka.common.config.types.Password;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.source.notification.ReceivedNotification;
import io.furrow.connect.source.option.SecurityOptions;

/**
 * Authenticates senders: a sender must present a secret and name an allowed tenant. Stores only digests of the secrets
 * and compares them in constant time.
 */
public final class RequestAuthenticator {
    private final String header;
    private final List<byte[]> secrets;
    private final Set<String> tenants;
    private final Ledger ledger;

    public RequestAuthenticator(SecurityOptions options, Ledger ledger) {
        this.header = options.secretHeader();
        this.secrets = options.secrets().stream()
                .map(Password::value)
                .map(RequestAuthenticator::digest)
                .toList();
        this.tenants = options.allowedTenants();
        this.ledger = ledger;
    }

    /** The answer to a request that is rejected; empty for an accepted one. The body need not have been read. */
    Optional<NotificationResponse> refuse(UnaryOperator<String> requestHeader) {
        if (!secrets.isEmpty() && !knowsASecret(requestHeader.apply(header))) {
            ledger.unauthorized.increment();
            return Optional.of(NotificationResponse.unauthorized());
        }
        if (!tenants.isEmpty()
                && !tenants.contains(ReceivedNotification.scope(requestHeader).service())) {
            ledger.foreignTenant.increment();
            return Optional.of(NotificationResponse.foreignTenant());
        }
        return Optional.empty();
    }

    private boolean knowsASecret(String value) {
        byte[] given = digest(value == null ? "" : value);
        boolean known = false;
        for (byte[] secret : secrets) {
            known |= MessageDigest.isEqual(secret, given);
        }
        return known;
    }

    private static byte[] digest(String text) {
        try {
            return MessageDigest.getInstance("SHA-256").digest(text.getBytes(StandardCharsets.UTF_8));
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-256", e);
        }
    }
}
