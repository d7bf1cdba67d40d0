package io.furrow.launcher.option;

import java.net.URI;
import java.nio.file.Path;
import java.util.List;

import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.launcher.suite.SuiteSettings;

/** Common options of {@code demo} and {@code up}: folder of data, and ports on 127.0.0.1. */
public final class SuiteOptions {
    @Option(
            names = "--data",
            paramLabel = "DIR",
            description =
                    "Store everything here across restarts: Kafka's log, Connect's offsets, checkpoints, entities, "
                            + "missions. Default: a temporary directory that is deleted at the end.")
    public Path data;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for every Kafka client, for instance security settings.")
    Path kafkaProperties;

    @Option(
            names = "--fiware-service",
            paramLabel = "NAME",
            description = "Tenant of the context broker. Default: ${DEFAULT-VALUE}.")
    public String fiwareService = "farm";

    @Option(
            names = "--window",
            paramLabel = "DURATION",
            description =
                    "Length of the windows over which a field's temperature is averaged. Default: ${DEFAULT-VALUE}.")
    String window = "10s";

    @Option(
            names = "--fields",
            paramLabel = "FILE",
            description =
                    "GeoJSON, Shapefile or GeoPackage with the farm's fields, written to service.fields at startup as "
                            + "the fields of all times before the first import. Default: the fields that exist; on the suite's own "
                            + "broker without fields, those of the demonstration farm.")
    Path fields;

    @Option(names = "--dashboard-port", paramLabel = "PORT", description = PORT_OF + "the dashboard" + DEFAULT)
    int dashboardPort = 8080;

    @Option(names = "--kafka-port", paramLabel = "PORT", description = PORT_OF + "Kafka" + DEFAULT)
    int kafkaPort = 9092;

    @Option(names = "--connect-port", paramLabel = "PORT", description = PORT_OF + "Connect's REST API" + DEFAULT)
    int connectPort = 8083;

    @Option(names = "--flink-port", paramLabel = "PORT", description = PORT_OF + "Flink's web UI" + DEFAULT)
    int flinkPort = 8081;

    @Option(
            names = "--notify-port",
            paramLabel = "PORT",
            description = PORT_OF + "the listener for notifications" + DEFAULT)
    int notifyPort = 8090;

    @Option(names = "--mqtt-port", paramLabel = "PORT", description = PORT_OF + "MQTT" + DEFAULT)
    int mqttPort = 1883;

    @Option(
            names = "--orion-port",
            paramLabel = "PORT",
            description = PORT_OF + "the context broker's stand-in" + DEFAULT)
    int orionPort = 1026;

    @Option(
            names = "--iot-agent-port",
            paramLabel = "PORT",
            description = PORT_OF + "the IoT Agent's stand-in" + DEFAULT)
    int iotAgentPort = 4041;

    @Option(
            names = "--mongo-port",
            paramLabel = "PORT",
            description = PORT_OF + "the server for missions that speaks MongoDB's protocol" + DEFAULT)
    int mongoPort = 27017;

    @Option(
            names = "--mongo",
            paramLabel = "URI",
            description =
                    "Store missions in this MongoDB, for instance mongodb://127.0.0.1:27018, and start no server. @FILE "
                            + "reads the URI, and so its password, from a file.")
    String mongo;

    @Option(
            names = "--control-port",
            paramLabel = "PORT",
            description = PORT_OF + "the control plane's REST API" + DEFAULT)
    int controlPort = 8085;

    @Option(
            names = "--health-port",
            paramLabel = "PORT",
            description = PORT_OF + "the control plane's pages /health, /ready and /metrics" + DEFAULT)
    int healthPort = 8086;

    @Mixin
    AccessFlags access;

    @Mixin
    TileFlags tiles;

    @Mixin
    WatchFlags watch;

    @Option(
            names = "--predict",
            paramLabel = "DURATION",
            description =
                    "Horizon of predicted encounters, 0s for none. Default: 10s with --stop-on-predicted, else 0s.")
    String horizon;

    private static final String PORT_OF = "Port of ";
    private static final String DEFAULT = ", 0 for a free one. Default: ${DEFAULT-VALUE}.";

    /** The demonstration's settings: simulated devices, and a shared login. */
    public SuiteSettings demonstration() {
        return suite(null, null, SuiteSettings.Farm.SIMULATED, SuiteSettings.Fiware.of(fiwareService));
    }

    public SuiteSettings settings(URI orion, String kafka, SuiteSettings.Farm farm, SuiteSettings.Fiware fiware) {
        return suite(orion, kafka, farm, fiware).withoutSharedLogin();
    }

    private SuiteSettings suite(URI orion, String kafka, SuiteSettings.Farm farm, SuiteSettings.Fiware fiware) {
        SuiteSettings.Ports ports = new SuiteSettings.Ports(
                kafkaPort,
                connectPort,
                flinkPort,
                notifyPort,
                mqttPort,
                orionPort,
                iotAgentPort,
                mongoPort,
                controlPort,
                healthPort,
                dashboardPort);
        return new SuiteSettings(
                kafkaProperties,
                fiware,
                window,
                fields,
                ports,
                orion,
                kafka,
                mongo,
                farm,
                watch.watch(horizon),
                access.allowed(),
                tiles.page(null, List.of()),
                true);
    }
}
