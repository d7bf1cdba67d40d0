package io.furrow.launcher.suite;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import io.furrow.cli.option.CommandException;
import io.furrow.control.WatchOptions;
import io.furrow.control.alarm.action.StopRobots;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.control.device.CommandSender;
import io.furrow.control.health.HealthOptions;
import io.furrow.control.mission.MissionSettings;
import io.furrow.dashboard.page.PageSettings;
import io.furrow.http.AllowedNames;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.provisioner.AgentSettings;
import io.furrow.provisioner.ConnectionSources;
import io.furrow.provisioner.MeasureReports;
import io.furrow.provisioner.account.MosquittoFiles;
import io.furrow.provisioner.account.MosquittoLog;
import io.furrow.provisioner.account.MqttAccounts;

/**
 * The settings of a suite.
 *
 * @param kafkaProperties for every Kafka client; null for none
 * @param fiware the missions' part of the context broker, and access to it
 * @param window of the temperature job, for instance {@code 10s}
 * @param fields a file; null for those on the topic, or of the demonstration farm on an embedded broker without fields
 * @param orion an existing context broker; null to start the stand-in
 * @param kafka bootstrap servers of an existing cluster; null to start a broker
 * @param mongo URI of an existing MongoDB; null to start a server
 * @param farm how devices of missions are provisioned and hosted
 * @param watch settings for alarms
 * @param allowed further hosts and origins of every HTTP server
 * @param page of the dashboard, without the images that the suite stores
 * @param sharedLogin whether the embedded MQTT broker has a login that may publish as any device
 */
public record SuiteSettings(
        Path kafkaProperties,
        Fiware fiware,
        String window,
        Path fields,
        Ports ports,
        URI orion,
        String kafka,
        String mongo,
        Farm farm,
        Watch watch,
        AllowedNames allowed,
        PageSettings page,
        boolean sharedLogin) {

    /**
     * FIWARE servers.
     *
     * @param scope tenant and service path of the missions' devices
     * @param tokenFile file of the token for existing servers; null for none
     * @param tokenHeader its header
     * @param token the same
     * @param listening where they and devices reach this suite
     */
    public record Fiware(
            FiwareScope scope, Path tokenFile, String tokenHeader, AccessToken token, Listening listening) {
        /** On this machine, without a token. */
        public static Fiware of(String service) {
            return new Fiware(FiwareScope.of(service, "/"), null, null, AccessToken.NONE, Listening.LOOPBACK);
        }
    }

    /**
     * The listeners for notifications and measures.
     *
     * @param host address of the listener for notifications
     * @param publicUrl of that listener for the context broker; null for address and port
     * @param secret file of the secret of notifications; null for none
     * @param mqttHost address of the embedded MQTT broker
     */
    public record Listening(String host, URI publicUrl, Path secret, String mqttHost) {
        public static final Listening LOOPBACK = new Listening("127.0.0.1", null, null, "127.0.0.1");

        /** The address by which this machine reaches a server that listens on it. */
        static String here(String host) {
            String address = "0.0.0.0".equals(host) ? "127.0.0.1" : "::".equals(host) ? "::1" : host;
            return address.contains(":") ? "[" + address + "]" : address;
        }
    }

    /** Ports on 127.0.0.1, or on the address of {@link Listening}, each 0 for a free one. */
    public record Ports(
            int kafka,
            int connect,
            int flink,
            int listener,
            int mqtt,
            int orion,
            int iotAgent,
            int mongo,
            int control,
            int health,
            int dashboard) {
        /** All free ones. */
        public static Ports free() {
            return new Ports(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
        }
    }

    /**
     * Settings for devices of missions.
     *
     * @param iotAgent an existing one, with an existing context broker; null for none, or for the stand-in
     * @param mqtt an existing MQTT broker, likewise
     * @param mqttPublic the MQTT broker as devices reach it; null if it is reached as here
     * @param mqttTrusted PEM file with the certificates to trust there; null for those that Java trusts
     * @param accounts files in which that broker finds the accounts of devices
     * @param secret of the farm
     * @param tokens file of the tokens for commands; null for unrestricted access
     * @param missions how missions are run
     */
    public record Farm(
            AgentSettings iotAgent,
            URI mqtt,
            URI mqttPublic,
            Path mqttTrusted,
            AccountFiles accounts,
            Secret secret,
            Path tokens,
            Missions missions) {
        /** Simulated devices on the stand-in and the embedded MQTT broker. */
        public static final Farm SIMULATED = new Farm(
                null,
                null,
                null,
                null,
                new AccountFiles(null, null, null, false, null, false),
                new Secret(null, null),
                null,
                new Missions(MissionSettings.START_TIMEOUT, true, true));
    }

    /**
     * Settings for running missions.
     *
     * @param startTimeout after which devices that have not come up are missing
     * @param simulates whether a host of simulated devices is started
     * @param simulatedByDefault whether devices are simulated by default
     */
    public record Missions(Duration startTimeout, boolean simulates, boolean simulatedByDefault) {}

    /**
     * The farm's secret.
     *
     * @param file null for one in the suite's directory
     * @param replaced fingerprint of the former secret; null for none
     */
    public record Secret(Path file, String replaced) {}

    /**
     * Mosquitto's files of users and their permissions.
     *
     * @param passwords null for none
     * @param rules null for none
     * @param reload command after a change; null for none
     * @param gateways whether each mission has an account that publishes for all its devices
     * @param log Mosquitto's; null for none
     * @param forgets whether to remove accounts and devices that were created for another Kafka
     */
    public record AccountFiles(Path passwords, Path rules, String reload, boolean gateways, Path log, boolean forgets) {
        /** Logins according to the broker's log. */
        public ConnectionSources connections() {
            return new ConnectionSources(log == null ? List.of() : List.of(new MosquittoLog(log)), MeasureReports.NONE);
        }

        /** The accounts of an MQTT broker with these files; empty without files. */
        public List<MqttAccounts> accounts() {
            if (passwords == null && rules == null) {
                return List.of();
            }
            if (passwords == null || rules == null) {
                throw new CommandException(
                        "Name both or none of --mqtt-password-file and --mqtt-acl-file: a password without rules lets nothing"
                                + " through, and rules without passwords let nobody in.");
            }
            return List.of(new MosquittoFiles(passwords, rules, reload));
        }
    }

    /**
     * Settings for alarms and the reactions to them.
     *
     * @param webhook target to which alarms are posted; null for none
     * @param health when a device counts as silent
     * @param horizon how far ahead encounters are predicted, as for the job {@code collision}
     * @param stops whether robots that are predicted to meet are stopped
     */
    public record Watch(Webhook.Settings webhook, HealthOptions health, String horizon, boolean stops) {
        public static final Watch DEFAULT = new Watch(null, HealthOptions.DEFAULT, "0s", false);

        /** @param robots sends Stop commands to robots */
        public WatchOptions options(CommandSender robots) {
            WatchOptions options = WatchOptions.DEFAULT.with(health);
            if (webhook != null) {
                options = options.with(webhook);
            }
            return stops ? options.with(StopRobots.Settings.of(robots)) : options;
        }
    }

    /** For {@code ./furrow up}: each device has its own login. */
    public SuiteSettings withoutSharedLogin() {
        return new SuiteSettings(
                kafkaProperties, fiware, window, fields, ports, orion, kafka, mongo, farm, watch, allowed, page, false);
    }

    /** A suite on free ports with embedded engines and the stand-in, for tests and measurements. */
    public static SuiteSettings onFreePorts(String window) {
        return new SuiteSettings(
                null,
                Fiware.of("farm"),
                window,
                null,
                Ports.free(),
                null,
                null,
                null,
                Farm.SIMULATED,
                Watch.DEFAULT,
                AllowedNames.NONE,
                PageSettings.DEFAULT,
                true);
    }
}
