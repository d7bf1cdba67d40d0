package io.furrow.control.rest;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Objects;

import io.furrow.model.device.FarmSecret;

/**
 * What the REST API is started with.
 *
 * @param host address to listen on; another than a loopback address needs {@code tokens}
 * @param port 0 for a free one
 * @param patience how long a request to a manager waits for its answer before it is told to repeat
 * @param tokens file of lines {@code <name> <token>}; null where no token is asked for
 * @param contextBroker through which commands go to devices; null where none do
 * @param secret of which the devices' credentials are made; null where they are not given out
 */
public record RestSettings(
        String host, int port, Duration patience, Path tokens, URI contextBroker, FarmSecret secret) {
    public RestSettings {
        Objects.requireNonNull(host);
        Objects.requireNonNull(patience);
    }

    /** On 127.0.0.1, without tokens, commands to devices and credentials. */
    public static RestSettings on(int port) {
        return new RestSettings("127.0.0.1", port, Duration.ofSeconds(15), null, null, null);
    }

    public RestSettings withHost(String newHost) {
        return new RestSettings(newHost, port, patience, tokens, contextBroker, secret);
    }

    public RestSettings withPatience(Duration newPatience) {
        return new RestSettings(host, port, newPatience, tokens, contextBroker, secret);
    }

    public RestSettings withTokens(Path file) {
        return new RestSettings(host, port, patience, file, contextBroker, secret);
    }

    public RestSettings withContextBroker(URI uri) {
        return new RestSettings(host, port, patience, tokens, uri, secret);
    }

    public RestSettings withSecret(FarmSecret newSecret) {
        return new RestSettings(host, port, patience, tokens, contextBroker, newSecret);
    }
}
