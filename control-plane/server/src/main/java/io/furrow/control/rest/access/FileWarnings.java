package io.furrow.control.rest.access;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;

import io.furrow.kafka.secret.SecretSource;

/**
 * Files that were changed and cannot be used as they are now, for a page that everybody may read: why is in the log.
 *
 * @param secret null if there is none
 * @param tokens null if none are asked for
 * @param tls null for plain HTTP
 */
public record FileWarnings(SecretSource secret, TokenFilter tokens, TlsListener tls) implements Supplier<List<String>> {
    @Override
    public List<String> get() {
        List<String> warnings = new ArrayList<>();
        if (secret != null && secret.problem().isPresent()) {
            warnings.add("the file of the farm's secret cannot be used as it is; the secret from before counts");
        }
        if (tokens != null && tokens.problem().isPresent()) {
            warnings.add("the file of tokens cannot be used as it is; the tokens from before count");
        }
        if (tls != null && tls.problem().isPresent()) {
            warnings.add("the files of the certificate cannot be used as they are; the certificate from before counts");
        }
        return warnings;
    }
}
