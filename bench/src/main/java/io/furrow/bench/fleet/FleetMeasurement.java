package io.furrow.bench.fleet;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.eclipse.paho.client.mqttv3.MqttException;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Wants devices on {@code service.devices}, lets a host in a JVM of its own run them, and counts what they report. */
public final class FleetMeasurement {
    private static final Duration TIMEOUT = Duration.ofMinutes(3);
    private static final Duration POLL = Duration.ofMillis(100);

    private final FleetPlan plan;
    private final FleetPlan.Ends ends;
    private final Properties client = new Properties();

    public FleetMeasurement(FleetPlan plan, FleetPlan.Ends ends) {
        this.plan = plan;
        this.ends = ends;
        client.setProperty("bootstrap.servers", ends.kafka());
    }

    /** @throws IOException if the devices do not come up */
    public FleetReport run() throws IOException, InterruptedException, MqttException {
        makeTopics();
        try (HostProcess host = HostProcess.start(plan, ends);
                MeasureListener listener = new MeasureListener(ends)) {
            long begun = System.nanoTime();
            want();
            awaitRunning(begun);
            Duration untilAllRun = Duration.ofNanos(System.nanoTime() - begun);
            TimeUnit.NANOSECONDS.sleep(plan.warmup().toNanos());
            Duration cpu = host.cpu();
            long from = System.nanoTime();
            listener.begin();
            TimeUnit.NANOSECONDS.sleep(plan.measured().toNanos());
            listener.end();
            double seconds = (System.nanoTime() - from) / 1e9;
            double used = host.cpu().minus(cpu).toNanos() / 1e9;
            return new FleetReport(
                    plan,
                    untilAllRun,
                    (long) (plan.devices() * seconds * 1000 / plan.period().toMillis()),
                    listener.arrived(),
                    plan.devices() - listener.devices(),
                    listener.delay(50),
                    listener.delay(99),
                    used / seconds,
                    host.peakMb());
        }
    }

    private void makeTopics() throws IOException, InterruptedException {
        try (Admin admin = Admin.create(client)) {
            admin.createTopics(List.of(Topics.DEVICES, Topics.DEVICES_STATUS, Topics.FIELDS).stream()
                            .map(topic ->
                                    new NewTopic(topic, 1, (short) 1).configs(Map.of("cleanup.policy", "compact")))
                            .toList())
                    .all()
                    .get();
        } catch (ExecutionException e) {
            throw new IOException("the topics service.* cannot be made at " + ends.kafka(), e);
        }
    }

    private void want() {
        try (KafkaProducer<String, byte[]> producer =
                new KafkaProducer<>(client, new StringSerializer(), new ByteArraySerializer())) {
            for (int i = 0; i < plan.devices(); i++) {
                DesiredDevice device = device(i);
                producer.send(
                        new ProducerRecord<>(Topics.DEVICES, device.version().key(), device.toBytes()));
            }
        }
    }

    private DesiredDevice device(int number) {
        String mission = plan.mission(number % plan.missions());
        String id = "urn:ngsi-ld:Thermometer:" + mission + "-" + (number / plan.missions() + 1);
        DeviceVersion version = new DeviceVersion(
                id, "bench", "/", "bench", mission, System.currentTimeMillis(), null, number + 1L, null);
        ObjectNode settings = NgsiJson.mapper().createObjectNode();
        settings.putArray("path").addArray().add(-3.5 + number % 100 / 10_000d).add(40.3 + number / 100 / 10_000d);
        return DesiredDevice.simulated(version, "Thermometer", id, true, plan.period(), settings);
    }

    private void awaitRunning(long begun) throws IOException {
        Set<String> running = new HashSet<>();
        List<String> failures = new ArrayList<>();
        TopicPartition partition = new TopicPartition(Topics.DEVICES_STATUS, 0);
        try (KafkaConsumer<String, byte[]> consumer =
                new KafkaConsumer<>(client, new StringDeserializer(), new ByteArrayDeserializer())) {
            consumer.assign(List.of(partition));
            consumer.seekToBeginning(List.of(partition));
            while (running.size() < plan.devices()) {
                for (ConsumerRecord<String, byte[]> each : consumer.poll(POLL)) {
                    DeviceStatus status = DeviceStatus.read(each.value());
                    if (status.state() == DeviceStatus.State.RUNNING) {
                        running.add(each.key());
                    } else {
                        failures.add(status.reason());
                    }
                }
                if (!failures.isEmpty() || System.nanoTime() - begun > TIMEOUT.toNanos()) {
                    throw new IOException("%d of %d devices run after %d s%s; see %s"
                            .formatted(
                                    running.size(),
                                    plan.devices(),
                                    (System.nanoTime() - begun) / 1_000_000_000,
                                    failures.isEmpty() ? "" : ", one says: " + failures.get(0),
                                    ends.folder().resolve("host.log")));
                }
            }
        } catch (UnreadableException e) {
            throw new IOException("a status record cannot be read", e);
        }
    }
}
