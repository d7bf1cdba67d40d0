package io.furrow.simulators.host;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLong;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.SecretFingerprints;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.device.MqttTestClient;
import io.furrow.simulators.mqtt.MqttAccess;

import static java.nio.charset.StandardCharsets.UTF_8;

/** All that a host of devices speaks to, and who asks it for devices in the place of the control plane. */
final class HostFixture implements AutoCloseable {
    static final String SECRET_TEXT = "0123456789abcdef";
    static final FarmSecret SECRET = new FarmSecret(SECRET_TEXT.getBytes(UTF_8));

    /** What hosts are given. */
    volatile FarmSecret secret = SECRET;

    final Map<String, String> passwords = new ConcurrentHashMap<>(Map.of("farmer", "plough"));
    final FiwareStandIn fiware;
    final EmbeddedKafka kafka;
    private final EmbeddedMqtt mqtt;
    private final KafkaProducer<String, byte[]> producer;
    private final AtomicLong sequence = new AtomicLong();

    HostFixture(Path directory) throws Exception {
        kafka = EmbeddedKafka.start(directory);
        mqtt = EmbeddedMqtt.start(passwords);
        fiware = FiwareStandIn.start(new FiwareSettings(0, 0, mqtt.uri(), "farmer", "plough"));
        producer = new KafkaProducer<>(kafka.client(), new StringSerializer(), new ByteArraySerializer());
        kafka.createTopics(List.of(Topics.DEVICES, Topics.DEVICES_STATUS, Topics.FIELDS, Topics.SECRETS).stream()
                .map(topic -> new NewTopic(topic, 1, (short) 1).configs(Map.of("cleanup.policy", "compact")))
                .toList());
    }

    HostSettings settings() {
        return HostSettings.of(
                kafka.client(),
                new MqttAccess(mqtt.uri(), null, 1),
                URI.create(fiware.contextBroker().toString()),
                () -> secret);
    }

    MqttTestClient listener() throws Exception {
        return new MqttTestClient(new FleetSettings(
                fiware.contextBroker(), fiware.iotAgent(), mqtt.uri(), "farmer", "plough", "farm", "/"));
    }

    /** Lets the broker know a device, as the control plane does. */
    void admit(String mission, String device) {
        FarmSecret.Login login = SECRET.device(mission, device);
        passwords.put(login.user(), login.password());
    }

    static String entity(String type, String mission, int number) {
        return "urn:ngsi-ld:%s:%s-%d".formatted(type, mission, number);
    }

    static String key(String entity) {
        return "farm|/|" + entity;
    }

    static String topic(String mission, String entity, String end) {
        return "/" + SECRET.apiKey(mission) + "/" + entity + "/" + end;
    }

    /** Asks for a device, or for its end; answers the sequence. */
    long addDesired(String mission, String entity, boolean running, String settings) throws Exception {
        return addDesired(mission, entity, running, settings, 0);
    }

    /** Asks for a device with new credentials. */
    long addRotated(String mission, String entity, String settings, int generation) throws Exception {
        return addDesired(mission, entity, true, settings, generation);
    }

    private long addDesired(String mission, String entity, boolean running, String settings, int generation)
            throws Exception {
        long number = sequence.incrementAndGet();
        long now = System.currentTimeMillis();
        DeviceVersion version = new DeviceVersion(
                entity, "farm", "/", "farm", mission, now, running ? null : Long.valueOf(now), number, null);
        ObjectNode json = (ObjectNode) NgsiJson.read(settings.getBytes(UTF_8));
        JsonNode carrier = json.remove("carriedBy");
        if (carrier != null) {
            version = new DeviceVersion(entity, "farm", "/", "farm", mission, now, null, number, carrier.textValue());
        }
        String type = entity.split(":")[2];
        DesiredDevice desired = DesiredDevice.simulated(version, type, entity, running, Duration.ofMillis(100), json)
                .withGeneration(generation);
        producer.send(new ProducerRecord<>(Topics.DEVICES, key(entity), desired.toBytes()))
                .get();
        return number;
    }

    /** Says which secret the farm has, as the control plane does. */
    void putFingerprints(FarmSecret farms) throws Exception {
        byte[] value = SecretFingerprints.of(farms).toBytes();
        put(Topics.SECRETS, SecretFingerprints.KEY, new String(value, UTF_8));
    }

    void delete(String entity) throws Exception {
        producer.send(new ProducerRecord<>(Topics.DEVICES, key(entity), null)).get();
    }

    void put(String topic, String key, String value) throws Exception {
        producer.send(new ProducerRecord<>(topic, key, value.getBytes(UTF_8))).get();
    }

    Optional<DeviceStatus> status(String entity) throws Exception {
        return Optional.ofNullable(statuses().get(key(entity)));
    }

    /** As the topic has them at its end. */
    Map<String, DeviceStatus> statuses() throws Exception {
        Map<String, DeviceStatus> newest = new HashMap<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(kafka.client(), Topics.DEVICES_STATUS)) {
            reader.readToEnd(
                    each -> newest.put(each.key(), each.value() == null ? null : DeviceStatus.read(each.value())));
        }
        return newest;
    }

    @Override
    public void close() {
        producer.close();
        fiware.close();
        mqtt.close();
        kafka.close();
    }
}
