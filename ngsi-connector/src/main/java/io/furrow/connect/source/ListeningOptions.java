package io.furrow.connect.source;

import java.time.Duration;
import java.util.OptionalInt;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

/** Where notifications are taken. */
record ListeningOptions(AbstractConfig config, int task) {
    static final String HOST = "listen.host";
    static final String PORT = "listen.port";
    static final String HEALTH_PORT = "health.port";
    static final String MAX_CONNECTIONS = "listen.max.connections";
    static final String IDLE_TIMEOUT = "listen.idle.timeout.ms";
    static final String REQUEST_TIMEOUT = "listen.request.timeout.ms";

    private static final int NO_PORT = -1;
    private static final long HOUR = Duration.ofHours(1).toMillis();

    static void define(ConfigDef options) {
        String group = "Listening";
        options.define(
                HOST,
                Type.STRING,
                "127.0.0.1",
                new ConfigDef.NonEmptyString(),
                Importance.HIGH,
                "Address to listen on for notifications. The default takes them from this machine only; set the address"
                        + " that the context broker reaches otherwise.",
                group,
                1,
                Width.MEDIUM,
                "Address");
        options.define(
                PORT,
                Type.INT,
                8090,
                Range.between(0, 65535),
                Importance.HIGH,
                "TCP port that the first task listens on; task i (from 0) listens on this port + i. 0 takes free ones,"
                        + " which only a test can use.",
                group,
                2,
                Width.SHORT,
                "Port");
        options.define(
                HEALTH_PORT,
                Type.INT,
                NO_PORT,
                Range.between(NO_PORT, 65535),
                Importance.LOW,
                "TCP port of the first task, at the same address, for /health and /metrics in plain HTTP beside the listener: for"
                        + " probes and scrapers where that asks for client certificates. Task i (from 0) has this port + i."
                        + " -1 for none; 0 takes free ones, which only a test can use.",
                group,
                3,
                Width.SHORT,
                "Health port");
        defineLimits(options, group);
    }

    private static void defineLimits(ConfigDef options, String group) {
        options.define(
                MAX_CONNECTIONS,
                Type.INT,
                2048,
                Range.between(1, 100_000),
                Importance.LOW,
                "Connections at a time; further ones wait in the network until one is closed. Each takes some 20 kB.",
                group,
                10,
                Width.SHORT,
                "Connections");
        options.define(
                IDLE_TIMEOUT,
                Type.LONG,
                30_000L,
                Range.between(100, HOUR),
                Importance.LOW,
                "Milliseconds after which a connection is closed on which nothing is sent.",
                group,
                11,
                Width.SHORT,
                "Idle (ms)");
        options.define(
                REQUEST_TIMEOUT,
                Type.LONG,
                20_000L,
                Range.between(100, HOUR),
                Importance.LOW,
                "Milliseconds from the first byte of a request to its answer, holding included; a slower sender is cut. More than "
                        + OverloadOptions.HOLD + ".",
                group,
                12,
                Width.SHORT,
                "Request (ms)");
    }

    int maxConnections() {
        return config.getInt(MAX_CONNECTIONS);
    }

    Duration idleTimeout() {
        return Duration.ofMillis(config.getLong(IDLE_TIMEOUT));
    }

    Duration requestTimeout() {
        return Duration.ofMillis(config.getLong(REQUEST_TIMEOUT));
    }

    String host() {
        return config.getString(HOST);
    }

    /** The port of this task; 0 for a free one. */
    int port() {
        return ofTask(firstPort());
    }

    /** The port of this task for the pages alone, 0 for a free one; empty where they are on the listener only. */
    OptionalInt healthPort() {
        int first = firstHealthPort();
        return first == NO_PORT ? OptionalInt.empty() : OptionalInt.of(ofTask(first));
    }

    private int ofTask(int first) {
        return first == 0 ? 0 : first + task;
    }

    /** The health port of the first task; -1 for none. */
    int firstHealthPort() {
        return config.getInt(HEALTH_PORT);
    }

    /** The port of the first task. */
    int firstPort() {
        return config.getInt(PORT);
    }
}
