package io.furrow.control.rest.access;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;

import io.furrow.kafka.secret.SecretSource;

/**
 * Warns about changed files that cannot be used, without details, because the page is public; the log has the reasons.
 *
 * @param secret null if there is none
 * @param tokens null if no token is required
 * @param tls null for plain HTTP
 */
public record FileWarnings(SecretSource secret, TokenFilter tokens, TlsListener tls) implements Supplier<List<String>> {
    @Override
    public List<String> get() {
        List<String> warnings = new ArrayList<>();
        if (secret != null && secret.problem().isPresent()) {
            warnings.add("the file of the farm's secret cannot be used as it is; the previous secret stays in use");
        }
        if (tokens != null && tokens.problem().isPresent()) {
            warnings.add("the file of tokens cannot be used as it is; the previous tokens stay valid");
        }
        if (tls != null && tls.problem().isPresent()) {
            warnings.add(
                    "the files of the certificate cannot be used as they are; the previous certificate stays in use");
        }
        return warnings;
    }
}
