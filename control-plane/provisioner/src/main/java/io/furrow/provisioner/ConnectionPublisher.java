package io.furrow.provisioner;

import java.time.Duration;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;
import java.util.function.LongSupplier;
import java.util.stream.Stream;

import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.topic.Topics;
import io.furrow.provisioner.account.LoginReport;

/**
 * Publishes on {@code service.devices.connection} what MQTT brokers and IoT Agent know of the devices: where it changed, of a
 * device at most every ten seconds. A login counts for a device whatever mission and generation its user names: a device that
 * still has old credentials is refused as a user that exists no longer.
 */
final class ConnectionPublisher {
    static final Duration INTERVAL = Duration.ofSeconds(10);
    private static final Logger LOG = LoggerFactory.getLogger(ConnectionPublisher.class);

    private final ProvisioningSettings settings;
    private final DesiredDeviceTable desired;
    private final Producer<String, byte[]> producer;
    private final LongSupplier clock;
    private final Long since;
    private final Map<String, DeviceConnection> published = new HashMap<>();
    private long last;

    /** @param clock epoch ms */
    ConnectionPublisher(
            ProvisioningSettings settings,
            DesiredDeviceTable desired,
            Producer<String, byte[]> producer,
            LongSupplier clock) {
        this.settings = settings;
        this.desired = desired;
        this.producer = producer;
        this.clock = clock;
        this.last = clock.getAsLong();
        this.since = settings.connections().logins().isEmpty() ? null : last;
    }

    /** @param before what is on the topic, by key: another process may have published meanwhile, or this one before it was started again */
    void startAnew(Map<String, DeviceConnection> before) {
        published.clear();
        published.putAll(before);
        last = clock.getAsLong();
    }

    /** @param registered keys of the devices that the IoT Agent knows; null before it was asked */
    void publish(Set<String> registered) {
        long now = clock.getAsLong();
        if (now - last < INTERVAL.toMillis()) {
            return;
        }
        last = now;
        Map<String, LoginReport> byDevice = new HashMap<>();
        Map<String, LoginReport> byMission = new HashMap<>();
        settings.connections()
                .logins()
                .forEach(broker -> broker.reports().forEach((user, report) -> {
                    FarmSecret.deviceOf(user)
                            .ifPresent(device -> byDevice.merge(device, report, ConnectionPublisher::both));
                    FarmSecret.missionOf(user)
                            .ifPresent(mission -> byMission.merge(mission, report, ConnectionPublisher::both));
                }));
        desired.all().forEach((key, device) -> {
            LoginReport gateway = byMission.get(device.version().mission());
            LoginReport own = byDevice.get(device.device());
            LoginReport login = withFormer(published.get(key), own == null ? onlyLogin(gateway) : own);
            put(key, connection(device, login, published.get(key), isIn(registered, key)));
        });
        new HashSet<>(published.keySet())
                .stream().filter(key -> !desired.all().containsKey(key)).forEach(key -> put(key, null));
    }

    /** What else its gateway does another device may have caused. */
    private static LoginReport onlyLogin(LoginReport gateway) {
        return gateway == null ? null : new LoginReport(gateway.loggedIn(), null, null);
    }

    /** With what was published before: who observes logins may have forgotten it, and the device may be connected since then. */
    private static LoginReport withFormer(DeviceConnection former, LoginReport login) {
        LoginReport before = former == null
                ? new LoginReport(null, null, null)
                : new LoginReport(former.loggedIn(), former.refusedLogin(), former.foreignTopic());
        return login == null ? before : both(login, before);
    }

    private static Boolean isIn(Set<String> registered, String key) {
        return registered == null ? null : Boolean.valueOf(registered.contains(key));
    }

    private DeviceConnection connection(
            DesiredDevice device, LoginReport login, DeviceConnection former, Boolean isRegistered) {
        String apiKey = settings.secret().get().apiKey(device.version().mission());
        return new DeviceConnection(
                since,
                login.loggedIn(),
                login.refused(),
                login.foreign(),
                settings.connections()
                        .measures()
                        .unreadable(apiKey, device.device())
                        .orElse(former == null ? null : former.unreadablePayload()),
                isRegistered);
    }

    private void put(String key, DeviceConnection connection) {
        boolean isNew =
                connection == null ? published.remove(key) != null : !connection.equals(published.put(key, connection));
        if (isNew) {
            byte[] value = connection == null ? null : connection.toBytes();
            producer.send(new ProducerRecord<>(Topics.DEVICES_CONNECTION, key, value), (sent, failure) -> {
                if (failure != null) {
                    LOG.warn("could not report how device {} is connected", key, failure);
                }
            });
        }
    }

    private static LoginReport both(LoginReport one, LoginReport other) {
        return new LoginReport(
                newest(one, other, LoginReport::loggedIn, Comparator.naturalOrder()),
                newest(one, other, LoginReport::refused, Comparator.comparingLong(RefusedLogin::last)),
                newest(one, other, LoginReport::foreign, Comparator.comparingLong(ForeignTopic::last)));
    }

    private static <T> T newest(
            LoginReport one, LoginReport other, Function<LoginReport, T> member, Comparator<T> order) {
        Optional<T> newest =
                Stream.of(one, other).map(member).filter(Objects::nonNull).max(order);
        return newest.orElse(null);
    }
}
