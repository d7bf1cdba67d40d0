package io.furrow.control.rest;

import java.io.IOException;
import java.net.InetAddress;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Objects;

import io.furrow.control.rest.access.CertificateFiles;
import io.furrow.http.AllowedNames;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.file.AccessToken;

/**
 * Settings of the REST API.
 *
 * @param host address to listen on; other than loopback addresses require {@code tokens}, and {@code certificate} or
 *     {@code insecure}
 * @param port 0 for a free one
 * @param timeout how long a request waits for a manager's answer before the client is asked to repeat it
 * @param tokens file of lines {@code <name> <token> <role>}; null if no token is required
 * @param certificate of TLS; null for plain HTTP
 * @param insecure whether other addresses may be served over plain HTTP, because a proxy terminates TLS
 * @param contextBroker receives commands to devices; null if commands are not supported
 * @param token of requests to the context broker
 * @param secret from which the devices' credentials are derived; null if they are not available
 * @param mqtt address of the MQTT broker for devices, {@code mqtt://} or {@code mqtts://}; null if unknown
 * @param allowed hosts and origins besides loopback and {@code host}, with or without tokens
 */
public record RestSettings(
        String host,
        int port,
        Duration timeout,
        Path tokens,
        CertificateFiles certificate,
        boolean insecure,
        URI contextBroker,
        AccessToken token,
        SecretSource secret,
        URI mqtt,
        AllowedNames allowed) {
    private static final Duration TIMEOUT = Duration.ofSeconds(15);

    public RestSettings {
        Objects.requireNonNull(host);
        Objects.requireNonNull(timeout);
        Objects.requireNonNull(allowed);
    }

    /** Returns settings for 127.0.0.1 over plain HTTP, without tokens, commands to devices and credentials. */
    public static RestSettings on(int port) {
        return new RestSettings(
                "127.0.0.1", port, TIMEOUT, null, null, false, null, AccessToken.NONE, null, null, AllowedNames.NONE);
    }

    public RestSettings withHost(String newHost) {
        return new RestSettings(
                newHost, port, timeout, tokens, certificate, insecure, contextBroker, token, secret, mqtt, allowed);
    }

    public RestSettings withTimeout(Duration newTimeout) {
        return new RestSettings(
                host, port, newTimeout, tokens, certificate, insecure, contextBroker, token, secret, mqtt, allowed);
    }

    public RestSettings withTokens(Path file) {
        return new RestSettings(
                host, port, timeout, file, certificate, insecure, contextBroker, token, secret, mqtt, allowed);
    }

    /** @param files null for plain HTTP */
    public RestSettings withCertificate(CertificateFiles files) {
        return new RestSettings(
                host, port, timeout, tokens, files, insecure, contextBroker, token, secret, mqtt, allowed);
    }

    public RestSettings withInsecure(boolean proxied) {
        return new RestSettings(
                host, port, timeout, tokens, certificate, proxied, contextBroker, token, secret, mqtt, allowed);
    }

    public RestSettings withContextBroker(URI uri) {
        return new RestSettings(host, port, timeout, tokens, certificate, insecure, uri, token, secret, mqtt, allowed);
    }

    public RestSettings withToken(AccessToken ofBroker) {
        return new RestSettings(
                host, port, timeout, tokens, certificate, insecure, contextBroker, ofBroker, secret, mqtt, allowed);
    }

    public RestSettings withSecret(SecretSource newSecret) {
        return new RestSettings(
                host, port, timeout, tokens, certificate, insecure, contextBroker, token, newSecret, mqtt, allowed);
    }

    public RestSettings withMqtt(URI broker) {
        return new RestSettings(
                host, port, timeout, tokens, certificate, insecure, contextBroker, token, secret, broker, allowed);
    }

    public RestSettings withAllowed(AllowedNames names) {
        return new RestSettings(
                host, port, timeout, tokens, certificate, insecure, contextBroker, token, secret, mqtt, names);
    }

    /** @throws IOException if the address requires tokens or TLS that are not configured; the message says what to do */
    public void check() throws IOException {
        if (InetAddress.getByName(host).isLoopbackAddress()) {
            return;
        }
        if (tokens == null) {
            throw new IOException(
                    "The REST API listens on %s only with tokens: anyone who reaches it controls the farm. Name a file of lines '<name> <token> <role>' (--api-tokens), or listen on 127.0.0.1."
                            .formatted(host));
        }
        if (certificate == null && !insecure) {
            throw new IOException(
                    ("The REST API listens on %s only with TLS: tokens and the passwords of devices would cross the network in the clear. Name a certificate"
                                    + " (--api-certificate and --api-certificate-key, or --api-keystore), or say with --api-insecure that a proxy in front of it ends TLS.")
                            .formatted(host));
        }
    }
}
