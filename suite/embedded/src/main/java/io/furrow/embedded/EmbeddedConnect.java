package io.furrow.embedded;

import java.net.URI;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;

import org.apache.kafka.connect.cli.ConnectDistributed;
import org.apache.kafka.connect.runtime.Connect;

import io.furrow.http.AllowedNames;
import io.furrow.http.connect.AccessExtension;

/** One distributed Connect worker in this JVM, with its REST API on 127.0.0.1 behind the access rule. */
public final class EmbeddedConnect implements AutoCloseable {
    private static final String HOST = "127.0.0.1";

    private final Connect<?> worker;
    private final URI uri;

    private EmbeddedConnect(Connect<?> worker, URI uri) {
        this.worker = worker;
        this.uri = uri;
    }

    /**
     * Starts and waits until the REST API answers. Connectors are created through it, as JSON.
     *
     * @param bootstrapServers the cluster that holds offsets, configurations and status
     * @param pluginPath a directory with one folder per plugin
     * @param restPort 0 for a free one
     * @param extra worker settings that override the defaults, for instance security
     */
    public static EmbeddedConnect start(
            String bootstrapServers, Path pluginPath, int restPort, Map<String, String> extra) {
        return start(bootstrapServers, pluginPath, restPort, extra, AllowedNames.NONE);
    }

    /** @param allowed further hosts and origins of the REST API */
    public static EmbeddedConnect start(
            String bootstrapServers, Path pluginPath, int restPort, Map<String, String> extra, AllowedNames allowed) {
        int port = FreePort.orFree(restPort);
        Map<String, String> settings = new HashMap<>(defaults(bootstrapServers, pluginPath, port));
        settings.put(AccessExtension.ALLOWED_HOSTS, String.join(",", allowed.hosts()));
        settings.put(AccessExtension.ALLOWED_ORIGINS, String.join(",", allowed.origins()));
        settings.putAll(extra);
        Connect<?> worker = new ConnectDistributed().startConnect(settings);
        return new EmbeddedConnect(worker, URI.create("http://" + HOST + ":" + port));
    }

    /** The REST API. */
    public URI uri() {
        return uri;
    }

    @Override
    public void close() {
        worker.stop();
        worker.awaitStop();
    }

    private static Map<String, String> defaults(String bootstrapServers, Path pluginPath, int port) {
        return Map.ofEntries(
                Map.entry("bootstrap.servers", bootstrapServers),
                Map.entry("group.id", "furrow-connect"),
                Map.entry("plugin.path", pluginPath.toString()),
                Map.entry("plugin.discovery", "service_load"),
                Map.entry("listeners", "http://" + HOST + ":" + port),
                Map.entry("rest.advertised.host.name", HOST),
                Map.entry("rest.extension.classes", AccessExtension.class.getName()),
                Map.entry("key.converter", "org.apache.kafka.connect.storage.StringConverter"),
                Map.entry("value.converter", "org.apache.kafka.connect.converters.ByteArrayConverter"),
                Map.entry("header.converter", "org.apache.kafka.connect.storage.StringConverter"),
                Map.entry("config.storage.topic", "connect-configs"),
                Map.entry("config.storage.replication.factor", "1"),
                Map.entry("offset.storage.topic", "connect-offsets"),
                Map.entry("offset.storage.partitions", "1"),
                Map.entry("offset.storage.replication.factor", "1"),
                Map.entry("status.storage.topic", "connect-status"),
                Map.entry("status.storage.partitions", "1"),
                Map.entry("status.storage.replication.factor", "1"),
                Map.entry("offset.flush.interval.ms", "5000"),
                Map.entry("connector.client.config.override.policy", "All"),
                Map.entry("producer.max.request.size", Integer.toString(16 * 1024 * 1024)),
                // A single worker need not wait for others to return.
                Map.entry("scheduled.rebalance.max.delay.ms", "0"));
    }
}
