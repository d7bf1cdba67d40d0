package io.furrow.connect.source;

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
    }

    String host() {
        return config.getString(HOST);
    }

    /** The port of this task; 0 for a free one. */
    int port() {
        return firstPort() == 0 ? 0 : firstPort() + task;
    }

    /** The port of the first task. */
    int firstPort() {
        return config.getInt(PORT);
    }
}
