package io.furrow.embedded;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.function.BiPredicate;
import java.util.function.Predicate;

import io.moquette.broker.MqttServer;
import io.moquette.broker.config.MemoryConfig;
import io.moquette.broker.security.IAuthenticator;
import io.moquette.broker.security.IAuthorizatorPolicy;
import io.moquette.broker.subscriptions.Topic;

/**
 * An MQTT 3.1.1 broker in this JVM, on 127.0.0.1 by default, that requires a user and password. A message to a topic to which its
 * sender may not publish is acknowledged and discarded, as in Mosquitto.
 */
public final class EmbeddedMqtt implements AutoCloseable {
    private static final String HOST = "127.0.0.1";
    private static final int MAX_MESSAGE_BYTES = 16 * 1024 * 1024;
    private static final int MAX_WAITING = 64 * 1024;

    private final MqttServer server;
    private final String host;
    private final int port;

    /**
     * Users that may change while the broker runs; checked at each connection, subscription and message.
     *
     * @param exists connections of users that do not exist are closed
     * @param mayRead called with the filter of a subscription, with wildcards or without
     */
    public record Users(
            BiPredicate<String, byte[]> authenticates,
            Predicate<String> exists,
            BiPredicate<String, String> mayWrite,
            BiPredicate<String, String> mayRead) {
        static final Users NOBODY =
                new Users((user, password) -> false, user -> false, (user, topic) -> false, (user, filter) -> false);
    }

    private EmbeddedMqtt(MqttServer server, String host, int port) {
        this.server = server;
        this.host = host;
        this.port = port;
    }

    /** Starts a broker on a free port. */
    public static EmbeddedMqtt start(Map<String, String> passwords) {
        return start(0, passwords);
    }

    /**
     * @param port 0 for a free one
     * @param passwords of each user
     */
    public static EmbeddedMqtt start(int port, Map<String, String> passwords) {
        return start(port, passwords, Users.NOBODY);
    }

    /**
     * @param port 0 for a free one
     * @param passwords of users with all permissions
     * @param others further users
     */
    public static EmbeddedMqtt start(int port, Map<String, String> passwords, Users others) {
        return start(HOST, port, passwords, others);
    }

    /**
     * @param host address to listen on
     * @param port 0 for a free one
     * @param passwords of users with all permissions
     * @param others further users
     */
    public static EmbeddedMqtt start(String host, int port, Map<String, String> passwords, Users others) {
        // Chosen here because Moquette learns its port only some time after its start.
        int bound = FreePort.orFree(port);
        Properties properties = new Properties();
        properties.setProperty("host", host);
        properties.setProperty("port", Integer.toString(bound));
        properties.setProperty("allow_anonymous", "false");
        // The broker assigns an id to clients without one, such as mosquitto_pub.
        properties.setProperty("allow_zero_byte_client_id", "true");
        properties.setProperty("persistence_enabled", "false");
        properties.setProperty("telemetry_enabled", "false");
        // Further messages are dropped silently.
        properties.setProperty("session_queue_size", Integer.toString(MAX_WAITING));
        properties.setProperty("netty.mqtt.message_size", Integer.toString(MAX_MESSAGE_BYTES));
        IAuthenticator authenticator = (clientId, user, password) -> user != null
                && password != null
                && (matches(passwords.get(user), password) || others.authenticates.test(user, password));
        MqttServer server = new MqttServer(
                new MemoryConfig(properties),
                new MqttServer.Access(
                        authenticator,
                        new Rights(passwords.keySet(), others),
                        user -> passwords.containsKey(user) || others.exists.test(user)));
        return new EmbeddedMqtt(server, host, bound);
    }

    /** {@code tcp://<host>:<port>}; with 127.0.0.1 if it listens on all addresses. */
    public URI uri() {
        String reached = host.equals("0.0.0.0") || host.equals("::") ? HOST : host;
        return URI.create("tcp://" + (reached.contains(":") ? "[" + reached + "]" : reached) + ":" + port);
    }

    @Override
    public void close() {
        server.close();
    }

    private static boolean matches(String expected, byte[] password) {
        return expected != null && MessageDigest.isEqual(expected.getBytes(StandardCharsets.UTF_8), password);
    }

    /** Grants all permissions to users with a password from the start. */
    private record Rights(Set<String> trusted, Users others) implements IAuthorizatorPolicy {
        @Override
        public boolean canWrite(Topic topic, String user, String client) {
            return trusted.contains(user) || others.mayWrite.test(user, topic.toString());
        }

        @Override
        public boolean canRead(Topic topic, String user, String client) {
            return trusted.contains(user) || others.mayRead.test(user, topic.toString());
        }
    }
}
