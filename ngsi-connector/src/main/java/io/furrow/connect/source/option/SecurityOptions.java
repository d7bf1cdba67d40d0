package io.furrow.connect.source.option;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.types.Password;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.model.file.FileProblem;

/** Options for the authentication of senders. */
public record SecurityOptions(AbstractConfig config) {
    static final String SECRET_HEADER = "secret.header";
    static final String SECRET = "secret";
    static final String SECRET_PREVIOUS = "secret.previous";
    static final String SECRET_FILE = "secret.file";
    static final String ALLOWED_TENANTS = "allowed.tenants";

    /** Denotes a notification without a tenant; no tenant can have this name. */
    static final String NO_TENANT = "-";

    private static final Validator HEADER_VALUE =
            Validators.one(SecurityOptions::requireHeaderValue, "printable ASCII");

    public SecurityOptions {
        if (config.getPassword(SECRET).value().isEmpty()
                && !config.getPassword(SECRET_PREVIOUS).value().isEmpty()) {
            throw new ConfigException(SECRET_PREVIOUS, Password.HIDDEN, "needs " + SECRET + " beside it");
        }
        if (!config.getPassword(SECRET).value().isEmpty() && config.getString(SECRET_FILE) != null) {
            throw new ConfigException(SECRET_FILE, config.getString(SECRET_FILE), "excludes " + SECRET);
        }
        inFile(config);
    }

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Security");
        Validator headers = Validators.matching("[A-Za-z0-9-]{1,64}", "the name of an HTTP header");
        group.text(SECRET_HEADER, "X-Furrow-Secret", headers, "Header")
                .help("Header whose value must be the secret. With Authorization the secret is the whole value, Bearer"
                        + " included.");
        group.high()
                .secret(SECRET, "", HEADER_VALUE, "Secret")
                .help("Secret that each notification must carry, else it is answered 401. Empty for none.");
        group.high()
                .secret(SECRET_PREVIOUS, "", HEADER_VALUE, "Previous secret")
                .help("Second secret that is accepted while senders change to the first.");
        group.text(SECRET_FILE, null, Validators.any("a path"), "Secret file")
                .help("File on the worker, read at the start, whose first line is the secret and whose second, if there"
                        + " is one, the previous secret, instead of " + SECRET + " and " + SECRET_PREVIOUS
                        + ": neither is in the connector's configuration then. Unset for none.");
        group.list(ALLOWED_TENANTS, "", Validators.any("names separated by commas"), "Tenants")
                .help("Tenants (fiware-service) whose notifications are accepted, " + NO_TENANT + " for those without"
                        + " one; others are answered 403, counted and not stored. Empty for all.");
    }

    private static void requireHeaderValue(Password secret) {
        String text = secret.value();
        Validators.require(
                text.matches("[ -~]*") && text.equals(text.strip()),
                "printable ASCII without spaces around it is expected");
    }

    public String secretHeader() {
        return config.getString(SECRET_HEADER);
    }

    /** The accepted secrets; empty if none is required. */
    public List<Password> secrets() {
        List<Password> inFile = inFile(config);
        return inFile.isEmpty()
                ? Stream.of(SECRET, SECRET_PREVIOUS)
                        .map(config::getPassword)
                        .filter(secret -> !secret.value().isEmpty())
                        .toList()
                : inFile;
    }

    private static List<Password> inFile(AbstractConfig config) {
        String file = config.getString(SECRET_FILE);
        if (file == null) {
            return List.of();
        }
        List<Password> secrets;
        try {
            secrets = Files.readAllLines(Path.of(file)).stream()
                    .map(String::strip)
                    .filter(line -> !line.isEmpty())
                    .map(Password::new)
                    .toList();
        } catch (IOException e) {
            throw new ConfigException(
                    SECRET_FILE, file, "cannot be read (" + FileProblem.of(e) + "); name a file with a secret");
        }
        if (secrets.isEmpty() || secrets.size() > 2) {
            throw new ConfigException(SECRET_FILE, file, "holds no secret: one line, or two during a change");
        }
        secrets.forEach(secret -> HEADER_VALUE.ensureValid(SECRET_FILE, secret));
        return secrets;
    }

    /** In lower case, the empty text for no tenant; empty if all are allowed. */
    public Set<String> allowedTenants() {
        return config.getList(ALLOWED_TENANTS).stream()
                .map(tenant -> tenant.equals(NO_TENANT) ? "" : tenant.toLowerCase(java.util.Locale.ROOT))
                .collect(Collectors.toUnmodifiableSet());
    }
}
