package io.furrow.launcher.command;

import java.io.PrintWriter;

import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;

/** Prints the addresses of all parts, once. */
final class UrlTable {
    private UrlTable() {}

    static void print(PrintWriter out, Suite suite) {
        out.println();
        row(out, "Dashboard", suite.dashboard());
        row(out, "Flink web UI", suite.flink());
        row(out, "Kafka", suite.kafka().bootstrapServers());
        row(out, "Missions (MongoDB)", suite.mongo().replaceAll("://[^/@]*@", "://***@"));
        row(out, "Connect REST", suite.connect() + "/connectors");
        SuiteSettings.Listening listening = suite.settings().fiware().listening();
        row(
                out,
                "Notifications (NGSI source)",
                (listening.publicUrl() == null ? suite.listener() : listening.publicUrl())
                        + (suite.hasStandIn() ? "" : "  must be reached by the context broker"));
        row(out, "Context broker (NGSI-v2)", suite.contextBroker() + "/v2/entities");
        row(out, "Control plane (REST)", suite.control() + "/openapi.json");
        row(out, "Health and metrics", suite.health() + "/ready");
        if (suite.hasStandIn()) {
            row(out, "IoT Agent", suite.devices().iotAgent() + "/iot/devices");
            row(out, "MQTT", suite.devices().mqtt() + "  " + login(suite));
        }
        if (!listening.mqttHost().equals(SuiteSettings.Listening.LOOPBACK.mqttHost())) {
            row(
                    out,
                    "MQTT of devices elsewhere",
                    "port %d of %s".formatted(suite.devices().mqtt().getPort(), listening.mqttHost()));
        } else if (!suite.hasStandIn()) {
            row(out, "Devices", "report to the MQTT broker or the port of the farm's own IoT Agent");
        }
        row(out, "Tenant", "fiware-service: " + suite.fiwareService());
        row(out, "Files and log", suite.directory());
        out.println();
        out.flush();
    }

    private static String login(Suite suite) {
        return suite.settings().sharedLogin()
                ? "user %s, password %s".formatted(Suite.MQTT_USER, Suite.MQTT_PASSWORD)
                : "a login for each device: list it in a mission, then ./furrow device credentials ID";
    }

    private static void row(PrintWriter out, String what, Object where) {
        out.printf("  %-30s %s%n", what, where);
    }
}
