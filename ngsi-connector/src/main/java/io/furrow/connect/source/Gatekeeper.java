package io.furrow.connect.source;

import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.UnaryOperator;

import org.apache.kafka.common.config.types.Password;

import io.furrow.connect.ledger.Ledger;

/**
 * Says who may send: whoever knows a secret, for a tenant that is allowed. It keeps digests of the secrets only, and compares
 * them in a time that tells nothing about them.
 */
final class Gatekeeper {
    private final String header;
    private final List<byte[]> secrets;
    private final Set<String> tenants;
    private final Ledger ledger;

    Gatekeeper(SecurityOptions options, Ledger ledger) {
        this.header = options.secretHeader();
        this.secrets = options.secrets().stream()
                .map(Password::value)
                .map(Gatekeeper::digest)
                .toList();
        this.tenants = options.allowedTenants();
        this.ledger = ledger;
    }

    /** The answer to a request that is not let in; empty for one that is. Its body need not have been read. */
    Optional<Answer> refuse(UnaryOperator<String> requestHeader) {
        if (!secrets.isEmpty() && !knowsASecret(requestHeader.apply(header))) {
            ledger.unauthorized.increment();
            return Optional.of(Answer.unauthorized());
        }
        if (!tenants.isEmpty()
                && !tenants.contains(ReceivedNotification.scope(requestHeader).service())) {
            ledger.foreignTenant.increment();
            return Optional.of(Answer.foreignTenant());
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
