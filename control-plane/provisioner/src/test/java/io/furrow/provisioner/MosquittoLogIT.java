package io.furrow.provisioner;

import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.device.FarmSecret;
import io.furrow.provisioner.account.LoginReport;
import io.furrow.provisioner.account.MosquittoLog;
import io.furrow.provisioner.account.MqttAccount;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Reads the log of a real Mosquitto. */
class MosquittoLogIT {
    private static final FarmSecret.Login DEVICE = DesiredDeviceFixture.SECRET.device("hoeing", "d");

    @Test
    void reportsConnectionsAndForbiddenTopics(@TempDir Path directory) throws Exception {
        long start = Instant.now().getEpochSecond() * 1000;
        try (ProvisionedMosquitto broker = new ProvisionedMosquitto(directory)) {
            broker.files().replace(List.of(MqttAccount.device(DesiredDeviceFixture.SECRET, "hoeing", "d")), Set.of());
            try (MqttPeer device = broker.connectOnceAccepted(DEVICE)) {
                device.publish("/" + DesiredDeviceFixture.SECRET.apiKey("hoeing") + "/d/attrs", "1");
                device.publish("/key/e/attrs", "2");
            }
            MosquittoLog log = new MosquittoLog(broker.log());

            await().until(() -> log.reports().containsKey(DEVICE.user())
                    && log.reports().get(DEVICE.user()).foreign() != null);
            LoginReport report = log.reports().get(DEVICE.user());
            assertThat(report.loggedIn()).isGreaterThanOrEqualTo(start);
            assertThat(report.foreign().topic()).isEqualTo("/key/e/attrs");
            assertThat(report.foreign().count()).isOne();
            assertThat(report.foreign().last()).isGreaterThanOrEqualTo(start);
        }
    }
}
