package io.furrow.connect.source.option;

import java.time.Duration;
import java.util.OptionalInt;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.OptionGroup;

/** Options for the HTTP listener. */
public record ListeningOptions(AbstractConfig config, int task) {
    public static final String HOST = "listen.host";
    public static final String PORT = "listen.port";
    public static final String HEALTH_PORT = "health.port";
    static final String MAX_CONNECTIONS = "listen.max.connections";
    static final String IDLE_TIMEOUT = "listen.idle.timeout.ms";
    public static final String REQUEST_TIMEOUT = "listen.request.timeout.ms";

    private static final int NO_PORT = -1;
    private static final long HOUR = Duration.ofHours(1).toMillis();

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Listening");
        group.high()
                .text(HOST, "127.0.0.1", new ConfigDef.NonEmptyString(), "Address")
                .help("Address to listen on for notifications. The default accepts them from this machine only; set the"
                        + " address that the context broker reaches if it runs elsewhere.");
        group.high()
                .integer(PORT, 8090, Range.between(0, 65535), "Port")
                .help("TCP port that the first task listens on; task i (from 0) listens on this port + i. 0 uses free"
                        + " ports, which only tests can use.");
        group.low()
                .integer(HEALTH_PORT, NO_PORT, Range.between(NO_PORT, 65535), "Health port")
                .help("TCP port of the first task, at the same address, for /health and /metrics in plain HTTP besides"
                        + " the listener: for probes and scrapers if the listener requires client certificates. Task i"
                        + " (from 0) has this port + i. -1 for none; 0 uses free ports, which only tests can use.");
        defineLimits(group);
    }

    private static void defineLimits(OptionGroup group) {
        group.low()
                .integer(MAX_CONNECTIONS, 2048, Range.between(1, 100_000), "Connections")
                .help("Maximum concurrent connections; further ones wait in the network until one is closed. Each uses"
                        + " about 20 kB.");
        group.low()
                .number(IDLE_TIMEOUT, 30_000L, Range.between(100, HOUR), "Idle (ms)")
                .help("Milliseconds after which an idle connection is closed.");
        group.low()
                .number(REQUEST_TIMEOUT, 20_000L, Range.between(100, HOUR), "Request (ms)")
                .help("Milliseconds from the first byte of a request to its answer, including the hold time; the"
                        + " connection of a slower sender is closed. More than " + OverloadOptions.HOLD + ".");
    }

    public int maxConnections() {
        return config.getInt(MAX_CONNECTIONS);
    }

    public Duration idleTimeout() {
        return Duration.ofMillis(config.getLong(IDLE_TIMEOUT));
    }

    public Duration requestTimeout() {
        return Duration.ofMillis(config.getLong(REQUEST_TIMEOUT));
    }

    public String host() {
        return config.getString(HOST);
    }

    /** The port of this task; 0 for a free one. */
    public int port() {
        return ofTask(firstPort());
    }

    /** The port of this task for /health and /metrics, 0 for a free one; empty if only the listener serves them. */
    public OptionalInt healthPort() {
        int first = firstHealthPort();
        return first == NO_PORT ? OptionalInt.empty() : OptionalInt.of(ofTask(first));
    }

    private int ofTask(int first) {
        return first == 0 ? 0 : first + task;
    }

    /** The health port of the first task; -1 for none. */
    public int firstHealthPort() {
        return config.getInt(HEALTH_PORT);
    }

    /** The port of the first task. */
    public int firstPort() {
        return config.getInt(PORT);
    }
}
