package io.furrow.launcher.suite;

import java.io.IOException;
import java.io.PrintWriter;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.Socket;
import java.net.SocketTimeoutException;
import java.net.URI;
import java.net.UnknownHostException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.Callable;
import java.util.concurrent.CancellationException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import com.mongodb.MongoException;
import com.mongodb.client.MongoClient;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.DescribeClusterOptions;
import org.apache.kafka.common.KafkaException;
import org.bson.BsonDocument;
import org.bson.BsonInt32;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.KafkaClient;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.text.FailureText;
import io.furrow.simulators.mqtt.MqttAccess;

/** Finds configured servers that do not answer, before anything is started. */
public final class ServerCheck {
    private static final Duration TIMEOUT = Duration.ofSeconds(3);
    private static final Duration POLL_INTERVAL = Duration.ofSeconds(1);
    private static final String NO_ANSWER = "nothing within %d s".formatted(TIMEOUT.toSeconds());
    private static final int MQTT = 1883;
    private static final int MQTT_TLS = 8883;

    private final List<Server> servers = new ArrayList<>();

    /**
     * @param address for messages, without a password
     * @param what as in {@code the context broker}
     */
    private record Server(String option, String address, String what, Callable<Void> question) {}

    /** @throws CommandException with a line for each that does not answer */
    static void answering(SuiteSettings settings) throws InterruptedException {
        ServerCheck check = new ServerCheck();
        check.tcp("--orion", settings.orion(), "the context broker");
        if (settings.farm().iotAgent() != null) {
            check.tcp("--iot-agent", settings.farm().iotAgent().base(), "the IoT Agent");
        }
        if (settings.farm().mqtt() != null) {
            check.mqtt(settings.farm().mqtt());
        }
        if (settings.mongo() != null) {
            check.mongo(settings.mongo());
        }
        if (settings.kafka() != null) {
            Properties client = KafkaClient.settings(settings.kafka(), settings.kafkaProperties());
            check.servers.add(new Server("--kafka", settings.kafka(), "Kafka", () -> kafka(client)));
        }
        check.require();
    }

    private void mqtt(URI uri) {
        try {
            tcp("--mqtt", new MqttAccess(uri, null, 1).broker(), "the MQTT broker");
        } catch (IllegalArgumentException e) {
            throw new CommandException("--mqtt: " + e.getMessage(), e);
        }
    }

    private void tcp(String option, URI uri, String what) {
        if (uri != null) {
            servers.add(new Server(option, uri.toString(), what, () -> tcp(uri)));
        }
    }

    private static Void tcp(URI uri) throws IOException {
        int port =
                uri.getPort() > 0 ? uri.getPort() : standardPort(uri.getScheme().toLowerCase(Locale.ROOT));
        try (Socket socket = new Socket()) {
            socket.connect(new InetSocketAddress(InetAddress.getByName(uri.getHost()), port), (int) TIMEOUT.toMillis());
        }
        return null;
    }

    private static int standardPort(String scheme) {
        return switch (scheme) {
            case "http" -> 80;
            case "https" -> 443;
            case "ssl" -> MQTT_TLS;
            default -> MQTT;
        };
    }

    private void mongo(String uri) {
        MongoAccess access = new MongoAccess(uri, null);
        try {
            servers.add(new Server("--mongo", access.toString(), "MongoDB", () -> {
                try (MongoClient client = MongoAccess.open(uri, TIMEOUT)) {
                    client.getDatabase("admin").runCommand(new BsonDocument("ping", new BsonInt32(1)));
                }
                return null;
            }));
        } catch (IllegalArgumentException e) {
            throw new CommandException(
                    "--mongo: %s. Name a URI such as mongodb://127.0.0.1:27017.".formatted(MongoAccess.fault(uri, e)),
                    e);
        }
    }

    private static Void kafka(Properties client) throws InterruptedException, ExecutionException, TimeoutException {
        try (Admin admin = Admin.create(client)) {
            admin.describeCluster(new DescribeClusterOptions().timeoutMs((int) TIMEOUT.toMillis()))
                    .nodes()
                    .get(TIMEOUT.toMillis(), TimeUnit.MILLISECONDS);
        }
        return null;
    }

    private void require() throws InterruptedException {
        ExecutorService threads = Executors.newCachedThreadPool(task -> {
            Thread thread = new Thread(task, "server-check");
            thread.setDaemon(true);
            return thread;
        });
        List<String> silent = new ArrayList<>();
        List<Future<Void>> answers = threads.invokeAll(
                servers.stream().map(Server::question).toList(),
                TIMEOUT.plusSeconds(1).toMillis(),
                TimeUnit.MILLISECONDS);
        for (int i = 0; i < servers.size(); i++) {
            Server server = servers.get(i);
            failure(answers.get(i))
                    .map(reason -> "%s %s: %s does not answer there (%s). Start it, or name another address."
                            .formatted(server.option(), server.address(), server.what(), reason))
                    .ifPresent(silent::add);
        }
        threads.shutdownNow();
        if (!silent.isEmpty()) {
            throw new CommandException(String.join(System.lineSeparator(), silent));
        }
    }

    private static Optional<String> failure(Future<Void> answer) throws InterruptedException {
        try {
            answer.get();
            return Optional.empty();
        } catch (CancellationException e) {
            return Optional.of(NO_ANSWER);
        } catch (ExecutionException e) {
            return Optional.of(reason(e.getCause()));
        }
    }

    /** In a few words. */
    private static String reason(Throwable failure) {
        if (failure instanceof UnknownHostException) {
            return "there is no host of this name";
        } else if (failure instanceof SocketTimeoutException
                || failure instanceof TimeoutException
                || failure instanceof com.mongodb.MongoTimeoutException
                || failure instanceof org.apache.kafka.common.errors.TimeoutException) {
            return NO_ANSWER;
        } else if (failure instanceof ExecutionException
                || failure instanceof KafkaException && failure.getCause() != null) {
            return reason(failure.getCause());
        } else if (failure instanceof MongoException refused) {
            return refused.getMessage().replaceFirst("(?s)[.:].*", "");
        }
        return FailureText.of(failure);
    }

    /**
     * Returns when Kafka answers, or at the stop. Prints once, after some seconds, that it does not: it may be started after this
     * process.
     *
     * @param err for messages
     */
    public static void awaitKafka(Properties client, PrintWriter err, CountDownLatch stop) throws InterruptedException {
        boolean problem = false;
        Optional<String> failure = kafkaFailure(client);
        while (failure.isPresent() && !stop.await(POLL_INTERVAL.toMillis(), TimeUnit.MILLISECONDS)) {
            if (!problem) {
                err.printf(
                        "Kafka at %s does not answer (%s). Check --kafka and --kafka-properties, and that it runs; it is asked again until it answers, or Ctrl-C.%n",
                        client.getProperty("bootstrap.servers"), failure.get());
                err.flush();
                problem = true;
            }
            failure = kafkaFailure(client);
        }
    }

    private static Optional<String> kafkaFailure(Properties client) throws InterruptedException {
        try {
            kafka(client);
            return Optional.empty();
        } catch (ExecutionException | TimeoutException | KafkaException e) {
            return Optional.of(reason(e));
        }
    }
}
