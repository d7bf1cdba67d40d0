package io.furrow.simulators.host;

import java.io.IOException;
import java.io.Reader;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Callable;
import java.util.concurrent.atomic.AtomicBoolean;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.file.AccessToken;
import io.furrow.model.file.PrivateFile;
import io.furrow.model.file.ReloadedFile;
import io.furrow.simulators.mqtt.MqttAccess;

/**
 * Runs the host of simulated devices as a process, in a container for instance; each option may be an environment
 * variable.
 */
@Command(
        name = "device-host",
        description = "Runs the devices desired on service.devices as a simulated fleet, until it is stopped.",
        mixinStandardHelpOptions = true,
        sortOptions = false)
public final class DeviceHostCommand implements Callable<Integer> {
    private static final Logger LOG = LoggerFactory.getLogger(DeviceHostCommand.class);

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            defaultValue = "${env:FURROW_KAFKA:-127.0.0.1:9092}",
            description = "Kafka. Default: $FURROW_KAFKA, else 127.0.0.1:9092.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            defaultValue = "${env:FURROW_KAFKA_PROPERTIES:-}",
            description =
                    "Further settings of Kafka clients, for instance a password. Default: $FURROW_KAFKA_PROPERTIES.")
    private String kafkaProperties;

    @Option(
            names = "--mqtt",
            paramLabel = "URI",
            defaultValue = "${env:FURROW_MQTT:-tcp://127.0.0.1:1883}",
            description = "MQTT broker, ssl://HOST:PORT with TLS. Default: $FURROW_MQTT, else tcp://127.0.0.1:1883.")
    private URI mqtt;

    @Option(
            names = "--mqtt-trusted",
            paramLabel = "FILE",
            defaultValue = "${env:FURROW_MQTT_TRUSTED:-}",
            description = "Trusted certificates in PEM. Default: $FURROW_MQTT_TRUSTED, else those of Java.")
    private String trusted;

    @Option(
            names = {"--qos", "--mqtt-qos"},
            paramLabel = "0|1",
            defaultValue = "${env:FURROW_MQTT_QOS:-1}",
            description =
                    "QoS of measures; with 0 they are lost while the connection is broken. Default: $FURROW_MQTT_QOS, "
                            + "else 1.")
    private int qos;

    @Option(
            names = {"--orion", "--context-broker"},
            paramLabel = "URL",
            defaultValue = "${env:FURROW_CONTEXT_BROKER:-http://127.0.0.1:1026}",
            description =
                    "Context broker, to which robots write. Default: $FURROW_CONTEXT_BROKER, else http://127.0.0.1:1026.")
    private URI contextBroker;

    @Option(
            names = "--fiware-token-file",
            paramLabel = "FILE",
            defaultValue = "${env:FURROW_FIWARE_TOKEN_FILE:-}",
            description =
                    "File whose first line is a token for the proxy that guards the context broker. Read again when it changes. Default: "
                            + "$FURROW_FIWARE_TOKEN_FILE, else none is sent.")
    private String tokenFile;

    @Option(
            names = "--fiware-token-header",
            paramLabel = "NAME",
            defaultValue = "${env:FURROW_FIWARE_TOKEN_HEADER:-" + AccessToken.DEFAULT_HEADER + "}",
            description = "Header of that token. Default: $FURROW_FIWARE_TOKEN_HEADER, else "
                    + AccessToken.DEFAULT_HEADER + ".")
    private String tokenHeader;

    @Option(
            names = "--farm-secret",
            paramLabel = "FILE",
            required = true,
            defaultValue = "${env:FURROW_FARM_SECRET}",
            description = "File with the farm's secret, the same as the control plane's. Default: $FURROW_FARM_SECRET.")
    private Path secret;

    @Option(
            names = "--seed",
            paramLabel = "N",
            defaultValue = "${env:FURROW_SEED:-0}",
            description = "Seed: another number creates other devices. Default: $FURROW_SEED, else 0.")
    private long seed;

    private DeviceHostCommand() {}

    /** Exits with 1 on failure, with the reason in the log. */
    public static void main(String[] arguments) {
        System.exit(new CommandLine(new DeviceHostCommand()).execute(arguments));
    }

    @Override
    public Integer call() throws InterruptedException {
        try {
            return runUntilStopped();
        } catch (IOException e) { // says what is wrong, and what to do
            spec.commandLine().getErr().println(e.getMessage());
            return 1;
        }
    }

    private int runUntilStopped() throws IOException, InterruptedException {
        DeviceHost host = DeviceHost.start(settings());
        AtomicBoolean requested = new AtomicBoolean();
        Runtime.getRuntime()
                .addShutdownHook(new Thread(
                        () -> {
                            requested.set(true);
                            host.close();
                        },
                        "device-host-stop"));
        spec.commandLine().getOut().println("Desired devices run until this is stopped.");
        spec.commandLine().getOut().flush();
        host.await();
        return requested.get() ? 0 : 1;
    }

    private HostSettings settings() throws IOException {
        Properties client = new Properties();
        if (!kafkaProperties.isBlank()) {
            try (Reader reader = Files.newBufferedReader(Path.of(kafkaProperties))) {
                client.load(reader);
            }
        }
        client.setProperty("bootstrap.servers", kafka);
        MqttAccess access = new MqttAccess(mqtt, trusted.isBlank() ? null : Path.of(trusted), qos);
        AccessToken token =
                tokenFile.isBlank() ? AccessToken.NONE : AccessToken.of(Path.of(tokenFile), tokenHeader, LOG::warn);
        return new HostSettings(client, access, contextBroker, secret(), token, seed);
    }

    private ReloadedFile<FarmSecret> secret() throws IOException {
        return ReloadedFile.open(List.of(secret), this::readSecret, LOG::warn);
    }

    private FarmSecret readSecret() throws IOException {
        FarmSecret read = FarmSecret.read(secret);
        PrivateFile.exposure(secret).ifPresent(LOG::warn);
        return read;
    }
}
