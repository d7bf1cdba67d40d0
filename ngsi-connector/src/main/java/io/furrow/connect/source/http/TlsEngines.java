package io.furrow.connect.source.http;

import java.io.IOException;
import java.security.KeyStore;
import java.security.KeyStoreException;
import java.security.cert.Certificate;
import java.security.cert.X509Certificate;
import java.time.Duration;
import java.time.Instant;
import java.util.Collections;
import java.util.Optional;
import javax.net.ssl.SSLEngine;

import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.security.auth.SslEngineFactory;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.source.option.TlsOptions;

/**
 * Creates the engines of TLS connections with Kafka's engine factory. When a file of keys or certificates has changed,
 * the next connection uses its new content; if that cannot be used, connections continue with the previous content.
 */
public final class TlsEngines implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TlsEngines.class);
    private static final long CHECK_NANOS = Duration.ofSeconds(1).toNanos();

    private final TlsOptions options;
    private SslEngineFactory factory;
    private long checked = System.nanoTime();
    private String problem = "";

    private TlsEngines(TlsOptions options, SslEngineFactory factory) {
        this.options = options;
        this.factory = factory;
    }

    /** @throws ConfigException naming the option and the cause if there are no usable keys */
    public static TlsEngines open(TlsOptions options) {
        try {
            return new TlsEngines(options, options.newEngineFactory());
        } catch (RuntimeException e) {
            // Kafka's messages name files and never hold a password.
            throw new ConfigException(
                    TlsOptions.KEYSTORE, options.location(), "the keys or certificates cannot be used: " + causes(e));
        }
    }

    /** For a connection that a client opened. */
    synchronized SSLEngine newEngine(String host, int port) {
        refresh();
        return factory.createServerSslEngine(host, port);
    }

    /**
     * The time at which the first certificate of the server's own chain expires; empty if the engine factory exposes
     * none.
     */
    public synchronized Optional<Instant> expiry() {
        refresh();
        KeyStore keys = factory.keystore();
        try {
            return keys == null ? Optional.empty() : firstExpiry(keys);
        } catch (KeyStoreException e) {
            throw new IllegalStateException("a loaded key store cannot be read", e);
        }
    }

    private static Optional<Instant> firstExpiry(KeyStore keys) throws KeyStoreException {
        Instant first = null;
        for (String alias : Collections.list(keys.aliases())) {
            Certificate[] chain = keys.isKeyEntry(alias) ? keys.getCertificateChain(alias) : new Certificate[0];
            for (Certificate each : chain) {
                Instant end = each instanceof X509Certificate x509
                        ? x509.getNotAfter().toInstant()
                        : Instant.MAX;
                first = first == null || end.isBefore(first) ? end : first;
            }
        }
        return Optional.ofNullable(first);
    }

    private void refresh() {
        long now = System.nanoTime();
        if (now - checked < CHECK_NANOS) {
            return;
        }
        checked = now;
        if (!factory.shouldBeRebuilt(options.settings())) {
            return;
        }
        try {
            SslEngineFactory next = options.newEngineFactory();
            close();
            factory = next;
            problem = "";
            LOG.info("loaded new TLS keys or certificates");
        } catch (RuntimeException e) {
            report(causes(e));
        }
    }

    /** Once per problem: each connection meets it again until the files are corrected. */
    private void report(String cause) {
        if (!cause.equals(problem)) {
            problem = cause;
            LOG.warn(
                    "new TLS keys or certificates cannot be used, the previous ones stay in use; correct the files: {}",
                    cause);
        }
    }

    private static String causes(Throwable failure) {
        StringBuilder causes = new StringBuilder(String.valueOf(failure.getMessage()));
        for (Throwable cause = failure.getCause(); cause != null; cause = cause.getCause()) {
            if (causes.indexOf(String.valueOf(cause.getMessage())) < 0) {
                causes.append(": ").append(cause.getMessage());
            }
        }
        return causes.toString();
    }

    @Override
    public synchronized void close() {
        try {
            factory.close();
        } catch (IOException e) {
            LOG.debug("an engine factory did not close", e);
        }
    }
}
