package io.furrow.provisioner;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.atomic.AtomicLong;

import org.apache.kafka.clients.producer.MockProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceConnection.UnreadablePayload;
import io.furrow.model.topic.Topics;
import io.furrow.provisioner.account.LoginReport;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class ConnectionPublisherTest {
    private static final long START = 1_700_000_000_000L;
    private static final long INTERVAL = ConnectionPublisher.INTERVAL.toMillis();

    private final MockProducer<String, byte[]> producer =
            new MockProducer<>(true, null, new StringSerializer(), new ByteArraySerializer());
    private final AtomicLong now = new AtomicLong(START);
    private final DesiredDeviceTable desired = new DesiredDeviceTable(DesiredDeviceFixture.SCOPE);
    private final DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
    private final String key = device.version().key();
    private final String user = SECRET.device("hoeing", device.device()).user();
    private final Map<String, LoginReport> logins = new HashMap<>();
    private UnreadablePayload unreadable;
    private final ConnectionPublisher publisher = publisher(new ConnectionSources(
            List.of(() -> logins),
            (apiKey, id) -> apiKey.equals(SECRET.apiKey("hoeing")) && id.equals(device.device())
                    ? Optional.ofNullable(unreadable)
                    : Optional.empty()));

    @BeforeEach
    void addDesired() {
        desired.take(key, device);
    }

    @Test
    void publishesTheReportsOfBrokerAndAgent() throws Exception {
        RefusedLogin refused = new RefusedLogin(2, START + 2, DeviceConnection.WRONG_PASSWORD, user);
        ForeignTopic foreign = new ForeignTopic(1, START + 3, "/k/e/attrs");
        unreadable = new UnreadablePayload(1, START + 4, "no JSON", "{");
        logins.put(user, new LoginReport(START + 1, refused, foreign));

        publish(Set.of(key));

        assertThat(producer.history())
                .extracting(ProducerRecord::topic, ProducerRecord::key)
                .containsExactly(tuple(Topics.DEVICES_CONNECTION, key));
        assertThat(newest()).isEqualTo(new DeviceConnection(START, START + 1, refused, foreign, unreadable, true));
    }

    /** After a rotation, or on another mission, a device tries its old credentials. */
    @Test
    void countsLoginsWithOldCredentialsForTheDevice() throws Exception {
        String old = SECRET.device("weeding", device.device(), 3).user();
        RefusedLogin refused = new RefusedLogin(7, START + 2, DeviceConnection.UNKNOWN_USER, old);
        logins.put(old, new LoginReport(null, refused, null));
        logins.put(user, new LoginReport(START + 1, null, null));
        logins.put("furrow.d.m.%zz.1.0", new LoginReport(null, refused, null));
        logins.put("stranger", new LoginReport(null, refused, null));

        publish(Set.of());

        assertThat(newest()).isEqualTo(new DeviceConnection(START, START + 1, refused, null, null, false));
    }

    @Test
    void usesTheLoginOfTheGatewayOfADevice() throws Exception {
        ForeignTopic foreign = new ForeignTopic(1, START, "/k/e/attrs");
        logins.put(SECRET.gateway("hoeing").user(), new LoginReport(START + 1, null, foreign));

        publish(Set.of(key));

        assertThat(newest()).isEqualTo(new DeviceConnection(START, START + 1, null, null, null, true));
    }

    @Test
    void publishesChangesAtMostEveryTenSeconds() {
        publish(null);
        publish(null);
        assertThat(producer.history()).hasSize(1);
        logins.put(user, new LoginReport(START + 1, null, null));
        publisher.publish(null);
        assertThat(producer.history()).hasSize(1);
        publish(null);
        assertThat(producer.history()).hasSize(2);

        desired.take(key, DesiredDeviceFixture.stopped(device));
        publish(null);
        publish(null);
        assertThat(producer.history()).hasSize(3);
        assertThat(producer.history().get(2).value()).isNull();
    }

    /** The log is read from a few megabytes before its end and the embedded broker loses its history, while a device may stay connected. */
    @Test
    void retainsReportsOverARestart() throws Exception {
        RefusedLogin refused = new RefusedLogin(2, START - 6, DeviceConnection.WRONG_PASSWORD, user);
        ForeignTopic foreign = new ForeignTopic(9, START - 4, "/k/e/attrs");
        UnreadablePayload former = new UnreadablePayload(1, START - 3, "no JSON", "{");
        publisher.reset(Map.of(key, new DeviceConnection(START - 9, START - 5, refused, foreign, former, true)));

        publish(Set.of(key));
        assertThat(newest()).isEqualTo(new DeviceConnection(START, START - 5, refused, foreign, former, true));

        unreadable = new UnreadablePayload(1, START + 2, "no JSON", "[");
        logins.put(user, new LoginReport(START + 1, null, new ForeignTopic(1, START + 3, "/k/f/attrs")));
        publish(Set.of(key));
        assertThat(newest())
                .isEqualTo(new DeviceConnection(
                        START, START + 1, refused, new ForeignTopic(1, START + 3, "/k/f/attrs"), unreadable, true));
    }

    @Test
    void goesOnWhenTheClockIsSetBack() {
        now.addAndGet(-7_200_000);
        publisher.publish(Set.of(key));
        assertThat(producer.history()).hasSize(1);
    }

    @Test
    void reportsThatLoginsAreNotObserved() throws Exception {
        ConnectionPublisher unobserved = publisher(ConnectionSources.NONE);
        now.addAndGet(INTERVAL);
        unobserved.publish(Set.of(key));

        assertThat(newest()).isEqualTo(new DeviceConnection(null, null, null, null, null, true));
    }

    private ConnectionPublisher publisher(ConnectionSources sources) {
        ProvisioningSettings settings = new ProvisioningSettings(
                new Properties(),
                DesiredDeviceFixture.SCOPE,
                SecretSource.of(SECRET),
                null,
                List.of(),
                true,
                sources,
                false);
        return new ConnectionPublisher(settings, desired, producer, now::get);
    }

    private void publish(Set<String> registered) {
        now.addAndGet(INTERVAL);
        publisher.publish(registered);
    }

    private DeviceConnection newest() throws Exception {
        return DeviceConnection.read(
                producer.history().get(producer.history().size() - 1).value());
    }
}
