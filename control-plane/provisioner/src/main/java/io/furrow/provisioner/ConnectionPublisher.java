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
import io.furrow.model.time.Elapsed;
import io.furrow.model.topic.Topics;
import io.furrow.provisioner.account.LoginReport;

/**
 * Publishes what MQTT brokers and IoT Agent report about the connections of devices on {@code
 * service.devices.connection}: only changes, at most one per device every ten seconds. A login counts for a device
 * regardless of the mission and generation in its user name, so that a device with old credentials, whose user no
 * longer exists, is recognized.
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

    /** @param before current records of the topic by key, written by another process or an earlier run */
    void reset(Map<String, DeviceConnection> before) {
        published.clear();
        published.putAll(before);
        last = clock.getAsLong();
    }

    /** @param registered keys of the devices that the IoT Agent has; null before the first request to it */
    void publish(Set<String> registered) {
        long now = clock.getAsLong();
        if (!Elapsed.hasPassed(INTERVAL.toMillis(), last, now)) {
            return;
        }
        last = now;
        Map<String, LoginReport> byDevice = new HashMap<>();
        Map<String, LoginReport> byMission = new HashMap<>();
        settings.connections()
                .logins()
                .forEach(broker -> broker.reports().forEach((user, report) -> {
                    FarmSecret.deviceOf(user)
                            .ifPresent(device -> byDevice.merge(device, report, ConnectionPublisher::merge));
                    FarmSecret.missionOf(user)
                            .ifPresent(mission -> byMission.merge(mission, report, ConnectionPublisher::merge));
                }));
        desired.all().forEach((key, device) -> {
            LoginReport gateway = byMission.get(device.version().mission());
            LoginReport own = byDevice.get(device.device());
            LoginReport login = mergePublished(published.get(key), own == null ? loginOf(gateway) : own);
            put(key, connection(device, login, published.get(key), isRegistered(registered, key)));
        });
        Set<String> removed = new HashSet<>(published.keySet());
        removed.removeAll(desired.all().keySet());
        removed.removeAll(desired.undecidedKeys());
        removed.forEach(key -> put(key, null));
    }

    /** Reduces the report of a gateway to its login: another device may have caused its other events. */
    private static LoginReport loginOf(LoginReport gateway) {
        return gateway == null ? null : new LoginReport(gateway.loggedIn(), null, null);
    }

    /** Merges the published state: the source may have forgotten the login while the device stays connected. */
    private static LoginReport mergePublished(DeviceConnection former, LoginReport login) {
        LoginReport before = former == null
                ? new LoginReport(null, null, null)
                : new LoginReport(former.loggedIn(), former.refusedLogin(), former.foreignTopic());
        return login == null ? before : merge(login, before);
    }

    private static Boolean isRegistered(Set<String> registered, String key) {
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
        boolean changed =
                connection == null ? published.remove(key) != null : !connection.equals(published.put(key, connection));
        if (changed) {
            byte[] value = connection == null ? null : connection.toBytes();
            producer.send(new ProducerRecord<>(Topics.DEVICES_CONNECTION, key, value), (sent, failure) -> {
                if (failure != null) {
                    LOG.warn("could not report how device {} is connected", key, failure);
                }
            });
        }
    }

    private static LoginReport merge(LoginReport one, LoginReport other) {
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
