package io.furrow.launcher.option;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import picocli.CommandLine.Option;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.file.AccessToken;
import io.furrow.provisioner.AgentSettings;

/** Options for access to commands, and for the registration of devices of missions. */
public final class ProvisioningOptions {
    @Option(
            names = "--iot-agent",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description =
                    "Provision devices of missions at this IoT Agent, for instance http://127.0.0.1:4041. Needs --orion; "
                            + "without this option no devices are provisioned at another context broker.")
    public URI iotAgent;

    @Option(
            names = "--iot-agent-resource",
            paramLabel = "PATH",
            description =
                    "Default resource of that IoT Agent (IOTA_DEFAULT_RESOURCE), through whose service groups it finds "
                            + "its devices; \"\" where it is empty. Default: " + AgentSettings.DEFAULT_RESOURCE + ".")
    private String resource;

    @Option(
            names = "--iot-agent-interval",
            paramLabel = "DURATION",
            description =
                    "Interval at which groups and devices of that IoT Agent are reconciled, so that lost ones are "
                            + "restored. Longer for many thousands of devices. Default: 30s.")
    private Duration interval;

    @Option(
            names = "--mqtt-password-file",
            paramLabel = "FILE",
            description = "Mosquitto's password_file, in which devices of missions get accounts. With --mqtt-acl-file.")
    Path passwords;

    @Option(
            names = "--mqtt-acl-file",
            paramLabel = "FILE",
            description = "Mosquitto's acl_file, in which they get the rules for publishing and subscribing.")
    Path rules;

    @Option(
            names = "--mqtt-reload",
            paramLabel = "COMMAND",
            description =
                    "Run by sh after a change of both, for instance 'kill -HUP $(cat /run/mosquitto/mosquitto.pid)'.")
    String reload;

    @Option(
            names = "--mqtt-log",
            paramLabel = "FILE",
            description =
                    "Mosquitto's log (log_dest file). It shows logins of devices and, with log_type all, publishes to "
                            + "topics of others; see ./furrow device show. It may not exist yet.")
    Path log;

    @Option(
            names = "--farm-secret",
            paramLabel = "FILE",
            description =
                    "The secret from which API keys and MQTT passwords are derived, see ./furrow secret. Default of up: "
                            + "farm-secret in the directory of --data, created with it.")
    public Path secret;

    @Option(
            names = "--replace-farm-secret",
            paramLabel = "FINGERPRINT",
            description =
                    "Replace the farm's lost secret, which has this fingerprint, by --farm-secret. Every device then "
                            + "needs new credentials.")
    public String replacedSecret;

    @Option(
            names = "--mqtt-gateways",
            description =
                    "Create an account per mission that may publish for all its devices, as ./furrow device-host needs "
                            + "beyond 500 devices.")
    public boolean gateways;

    @Option(
            names = "--forget-devices",
            description =
                    "For one start: remove IoT Agent devices and MQTT accounts that were created for another Kafka, or "
                            + "for one whose data is lost. Default: they stay, and an alarm names them.")
    public boolean forgets;

    @Option(
            names = "--mqtt-public-url",
            paramLabel = "URL",
            description =
                    "MQTT broker as devices reach it, for their credentials: mqtt://host[:port], or mqtts:// with TLS. Default of up: "
                            + "its own broker, else that of --mqtt; of control-plane: none.")
    private URI mqttPublic;

    @Option(
            names = "--start-timeout",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description =
                    "How long devices of a mission may take to report. Then the missing ones are named and an alarm is "
                            + "raised; the mission waits for them. Default: ${DEFAULT-VALUE}.")
    public Duration startTimeout;

    @Option(
            names = "--api-tokens",
            paramLabel = "FILE",
            description =
                    "Require a token at the control plane's REST API: lines '<name> <token> <role>', the role viewer, "
                            + "operator or admin. Read again when it changes. Default: anyone who reaches 127.0.0.1 may do "
                            + "everything.")
    public Path tokens;

    /**
     * The MQTT broker as devices reach it; null if not configured.
     *
     * @throws CommandException if the address is invalid
     */
    public URI mqttPublic() {
        if (mqttPublic != null
                && (mqttPublic.getHost() == null
                        || !List.of("mqtt", "mqtts", "tcp", "ssl").contains(mqttPublic.getScheme()))) {
            throw new CommandException(
                    "--mqtt-public-url must be mqtt://host[:port], or mqtts://host[:port] with TLS, not '%s'."
                            .formatted(mqttPublic));
        }
        return mqttPublic;
    }

    /**
     * The IoT Agent; null if not configured.
     *
     * @throws CommandException if the options are invalid or contradict each other
     */
    public AgentSettings agent(String fiwareService, AccessToken token) {
        if (iotAgent == null) {
            if (passwords != null || rules != null || reload != null || log != null) {
                throw new CommandException(
                        "--mqtt-password-file, --mqtt-acl-file, --mqtt-reload and --mqtt-log need --iot-agent: "
                                + "only devices that are provisioned get accounts.");
            }
            if (resource != null || interval != null) {
                throw new CommandException(
                        "--iot-agent-resource and --iot-agent-interval need --iot-agent: the stand-in has its own.");
            }
            return null;
        }
        if (fiwareService.isBlank()) {
            throw new CommandException(
                    "--iot-agent needs a tenant: name one with --fiware-service. An IoT Agent keeps no devices of the default one.");
        }
        try {
            AgentSettings agent = AgentSettings.at(iotAgent).withToken(token);
            agent = resource == null ? agent : agent.withResource(resource);
            return interval == null ? agent : agent.withInterval(interval);
        } catch (IllegalArgumentException e) { // says which setting is wrong
            throw new CommandException(e.getMessage(), e);
        }
    }

    public SuiteSettings.AccountFiles accounts() {
        return new SuiteSettings.AccountFiles(passwords, rules, reload, gateways, log, forgets);
    }

    SuiteSettings.Secret secret() {
        return new SuiteSettings.Secret(secret, replacedSecret);
    }
}
