package io.furrow.launcher.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.launcher.Furrow;
import io.furrow.launcher.process.RestClient;
import io.furrow.launcher.suite.Suite;

import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class ScenarioCommandIT {
    private static final String SCENARIO = """
            {"seed": 7, "apiKey": "secret", "missions": [{"domain": "farm", "mission": "weeding", "devices": [
              {"type": "Thermometer", "id": "t", "count": 3, "at": {"latitude": 40.31, "longitude": -3.48},
               "where": "yard", "period": "PT0.2S", "meanCelsius": 18}]}]}
            """;

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @AutoClose
    private EmbeddedMqtt mqtt;

    @AutoClose
    private FiwareStandIn fiware;

    @BeforeEach
    void start() {
        mqtt = EmbeddedMqtt.start(Map.of(Suite.MQTT_USER, Suite.MQTT_PASSWORD));
        fiware = FiwareStandIn.start(new FiwareSettings(0, 0, mqtt.uri(), Suite.MQTT_USER, Suite.MQTT_PASSWORD));
    }

    @Test
    void runsTheDevicesOfAFileUntilTheTimeIsOver(@TempDir Path directory) throws Exception {
        assertThat(run(Files.writeString(directory.resolve("farm.json"), SCENARIO), "--for", "2s"))
                .as("%s", err)
                .isZero();

        assertThat(out.toString()).contains("Runs 3 devices", " 0 open, 0 dropped");
        URI entities = URI.create(fiware.contextBroker() + "/v2/entities?type=Thermometer");
        assertThat(new RestClient()
                        .get(entities, Map.of("fiware-service", "farm"))
                        .body())
                .hasSize(3)
                .allSatisfy(entity ->
                        assertThat(entity.at("/Temperature/value").isNumber()).isTrue());
    }

    @Test
    void reportsWhatIsWrongWithAFile(@TempDir Path directory) throws Exception {
        String wrong = SCENARIO.replace("PT0.2S", "often");

        assertThat(run(Files.writeString(directory.resolve("farm.json"), wrong)))
                .isNotZero();
        assertThat(run(directory.resolve("nosuch.json"))).isNotZero();

        assertThat(err.toString()).contains("period", "often", "nosuch.json cannot be read; name a scenario file");
    }

    private int run(Path file, String... further) {
        String[] arguments = {
            "scenario", file.toString(),
            "--orion", fiware.contextBroker().toString(),
            "--iot-agent", fiware.iotAgent().toString(),
            "--mqtt", mqtt.uri().toString()
        };
        String[] all = java.util.Arrays.copyOf(arguments, arguments.length + further.length);
        System.arraycopy(further, 0, all, arguments.length, further.length);
        return Furrow.commandLine()
                .setOut(new PrintWriter(out, true))
                .setErr(new PrintWriter(err, true))
                .execute(all);
    }
}
