package io.furrow.simulators.fleet;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;

import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.device.FarmSecret;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.Farm;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** A fleet and a real Mosquitto with password file and TLS. */
@Tag("full")
class FleetMosquittoIT {
    private static final String FARM = """
            {"seed": 1, "apiKey": "k", "missions": [{"domain": "farm", "mission": "weeding", "devices": [
                {"type": "Thermometer", "id": "t", "count": 20, "at": {"latitude": 40.31, "longitude": -3.48}, "period": "PT0.02S"}]}]}
            """;

    private static final Duration TIMEOUT = Duration.ofMinutes(1);

    @TempDir
    private static Path directory;

    private static FleetMosquitto broker;

    @BeforeAll
    static void startBroker() throws Exception {
        broker = FleetMosquitto.start(directory, "farmer", "plough");
    }

    @AfterAll
    static void stopBroker() throws Exception {
        broker.stop();
    }

    @Test
    void rejectsADeviceWithAWrongPassword() {
        assertThatThrownBy(() -> fleet(broker.certificate(), "harrow", 500))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("refuses user 'farmer': check user name and password");
    }

    @Test
    void speaksWithNoBrokerThatItDoesNotTrust() {
        assertThatThrownBy(() -> fleet(null, "plough", 500))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("is its certificate trusted?");
    }

    /** With a connection for each device, and through a gateway. */
    @ParameterizedTest
    @CsvSource({"500, 20", "5, 1"})
    void bringsEveryMeasureThroughFiveRestarts(int maxOwn, int connections) throws Exception {
        try (Subscriber subscriber = Subscriber.to(broker, "subscriber-" + maxOwn);
                FarmFleet fleet = fleet(broker.certificate(), "plough", maxOwn)) {
            assertThat(fleet.connections()).isEqualTo(connections);
            for (int i = 0; i < 5; i++) {
                long before = fleet.tally().acknowledged();
                await().until(() -> fleet.tally().acknowledged() > before + 500);
                broker.restart();
            }
            long before = fleet.tally().acknowledged();
            await().until(() -> fleet.tally().acknowledged() > before + 500);

            assertThat(fleet.drain(TIMEOUT)).isTrue();
            assertThat(fleet.tally()).isEqualTo(new FarmFleet.Tally(fleet.reports(), 0, 0));
            // It connects again as late as the fleet did, and has then everything to receive.
            await().atMost(TIMEOUT)
                    .untilAsserted(
                            () -> assertThat(subscriber.measures().size()).isEqualTo((int) fleet.reports()));
        }
    }

    /** The mission has the name of a user that somebody else has, as the IoT Agent may be. */
    @Test
    void connectsWithTheLoginsOfTheFarmsSecretBesideAUserOfTheMissionsName() throws Exception {
        FarmSecret secret = FarmSecret.generate();
        FarmSecret.Login gateway = secret.gateway("farmer");
        broker.add(gateway.user(), gateway.password());
        String farm = FARM.replace("weeding", "farmer");
        FleetAccess access = new FleetAccess(
                new FleetSettings(null, null, broker.uri(), null, null, "farm", "/"),
                new MqttAccess(broker.uri(), broker.certificate(), 1),
                FleetAccess.Logins.of(() -> secret));

        // Mosquitto reads its files a moment after it is told to.
        try (FarmFleet fleet = await().ignoreExceptions()
                        .until(() -> fleet(farm, access, 5), started -> started.connections() == 1);
                Subscriber subscriber = Subscriber.to(broker, "subscriber-farmer")) {
            await().until(() -> subscriber.measures().size() > 20);
            assertThat(fleet.tally().dropped()).isZero();
        }
    }

    private static FarmFleet fleet(Path trusted, String password, int maxOwn) throws IOException {
        FleetSettings settings = new FleetSettings(null, null, broker.uri(), "farmer", password, "farm", "/");
        FleetAccess access = new FleetAccess(
                settings,
                new MqttAccess(broker.uri(), trusted, 1),
                FleetAccess.Logins.all(new MqttAccess.Login("farmer", password)));
        return fleet(FARM, access, maxOwn);
    }

    private static FarmFleet fleet(String scenario, FleetAccess access, int maxOwn) throws IOException {
        Farm farm = Farm.read(new ByteArrayInputStream(scenario.getBytes(UTF_8)), Instant.now());
        return FarmFleet.start(farm, access, maxOwn, Clock.systemUTC());
    }
}
