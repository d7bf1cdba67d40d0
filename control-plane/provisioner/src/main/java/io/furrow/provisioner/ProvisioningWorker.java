package io.furrow.provisioner;

import java.io.IOException;
import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.consumer.ConsumerRebalanceListener;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.Uuid;
import org.apache.kafka.common.errors.InterruptException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;
import io.furrow.provisioner.RemovalGuard.Retained;

/**
 * Provisions the devices of {@code service.devices} at the IoT Agent and at the MQTT brokers, and removes all others.
 * One of several instances is active; another takes over when it fails. The active instance first reads all desired
 * devices and the registrations of the agent. It works in steps of a few seconds and polls Kafka in between, so that a
 * slow agent does not cost it its partition. It retries an unavailable agent forever; a rejected device, or a new one
 * that waits for the agent, is reported as {@code failed} on {@code service.devices.status} with the reason.
 */
final class ProvisioningWorker implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ProvisioningWorker.class);
    /** Name of the consumer group; never changed, else two instances would be active during an update. */
    static final String GROUP = "furrow-provisioner";

    private static final String TAKEN_OVER_AFTER_MS = "10000";
    private static final Duration POLL_INTERVAL = Duration.ofMillis(500);
    private static final Duration ADMIN_TIMEOUT = Duration.ofSeconds(15);

    private final KafkaConsumer<String, byte[]> consumer;
    private final KafkaProducer<String, byte[]> producer;
    private final DesiredDeviceTable desired;
    private final Properties client;
    private final String agent;
    /** Reads {@code service.missions.devices}; null while another instance is active. */
    private CommittedReader<String> lists;

    private final ProvisioningReconciler provisioning;
    private final RetrySchedule retrySchedule;
    private final FailureReporter failures;
    private final ConnectionPublisher connections;
    private final Map<TopicPartition, Long> unread = new HashMap<>();
    private boolean active;
    private String failure = "";
    private Retained retained;
    private long retainedReported;
    private boolean provisionedRecorded;

    ProvisioningWorker(ProvisioningSettings settings) {
        this.desired = new DesiredDeviceTable(settings.scope());
        this.provisioning = new ProvisioningReconciler(settings, desired, System::nanoTime);
        this.retrySchedule =
                new RetrySchedule(System::nanoTime, settings.agent().interval());
        this.client = settings.client();
        this.agent = settings.agent().base().toString();
        this.consumer = KafkaClients.consumer(consumerSettings(client));
        this.producer = KafkaClients.producer(client);
        this.failures = new FailureReporter(desired, producer, System::nanoTime);
        this.connections = new ConnectionPublisher(settings, desired, producer, System::currentTimeMillis);
        consumer.subscribe(List.of(Topics.DEVICES), new Assignment());
    }

    private static Properties consumerSettings(Properties client) {
        Properties settings = CommittedReader.settings(client);
        settings.setProperty("group.id", GROUP);
        settings.setProperty("session.timeout.ms", TAKEN_OVER_AFTER_MS);
        return settings;
    }

    /** Processes new records and, if this instance is active, executes one step of a few seconds. */
    void next() throws InterruptedException {
        take(consumer.poll(retrySchedule.pause(POLL_INTERVAL)));
        if (active && readLists()) {
            retrySchedule.requested();
        }
        if (active && provisioning.isSecretChanged()) {
            retrySchedule.requested();
        }
        if (active && isCaughtUp()) {
            if (retrySchedule.isDue()) {
                step();
            }
            reportRetained();
            failures.undecided();
            connections.publish(provisioning.registered());
        }
    }

    /** Returns the reason for waiting, for people. */
    String detail() {
        return active ? failure : "standby";
    }

    @Override
    public void close() {
        consumer.close();
        closeLists();
        producer.close();
    }

    private void take(ConsumerRecords<String, byte[]> records) {
        for (ConsumerRecord<String, byte[]> record : records) {
            try {
                desired.take(record.key(), record.value() == null ? null : DesiredDevice.read(record.value()));
            } catch (UnreadableException e) {
                LOG.warn("{} is not a desired device: nothing is removed", KafkaClients.position(record), e);
                desired.takeUnreadable(record.key());
            }
        }
        if (!records.isEmpty()) {
            retrySchedule.requested();
        }
    }

    /** Processes the available records, without waiting. Returns whether there were any. */
    private boolean readLists() {
        ConsumerRecords<String, byte[]> records = lists.poll(Duration.ZERO);
        records.forEach(record -> desired.takeList(record.key(), record.value()));
        return !records.isEmpty();
    }

    private Map<String, DeviceConnection> publishedConnections() {
        Map<String, DeviceConnection> published = new HashMap<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(client, Topics.DEVICES_CONNECTION)) {
            reader.readToEnd(record -> {
                published.remove(record.key());
                try {
                    if (record.value() != null) {
                        published.put(record.key(), DeviceConnection.read(record.value()));
                    }
                } catch (UnreadableException e) { // written by a later version; its history starts again
                    LOG.debug("{} is not a connection of a device", KafkaClients.position(record), e);
                }
            });
        }
        return published;
    }

    private void closeLists() {
        if (lists != null) {
            lists.close();
            lists = null;
        }
    }

    private boolean isCaughtUp() {
        if (unread.entrySet().removeIf(each -> consumer.position(each.getKey()) >= each.getValue())
                && unread.isEmpty()) {
            desired.caughtUp();
            retrySchedule.requested();
        }
        return unread.isEmpty() && lists.isCaughtUp();
    }

    private void step() throws InterruptedException {
        if (retrySchedule.isRefreshDue()) {
            provisioning.refresh();
        }
        try {
            ProvisioningReconciler.Outcome outcome = provisioning.step();
            failures.available();
            if (!outcome.done()) {
                retrySchedule.runNow();
                return;
            }
            failures.rejected(outcome.rejected());
            failure = outcome.retained() == null ? "" : outcome.retained().summary();
            if (outcome.retained() != null && !outcome.retained().equals(retained)) {
                LOG.warn(outcome.retained().text());
                retainedReported = System.nanoTime() - FailureReporter.REPORT_INTERVAL.toNanos();
            }
            retained = outcome.retained();
            recordProvisioned();
            if (outcome.rejected().isEmpty() && outcome.removalFailure() == null) {
                retrySchedule.succeeded();
            } else if (retrySchedule.failed() && outcome.removalFailure() != null) {
                LOG.warn(
                        "devices that are no longer desired stay at the IoT Agent; retrying: {}",
                        outcome.removalFailure());
            }
        } catch (IOException e) {
            failure = FailureText.of(e);
            if (retrySchedule.failed()) {
                LOG.warn("devices are not provisioned yet, retrying: {}", e.getMessage(), e);
            }
            failures.unavailable(FailureText.of(e));
        }
    }

    /** Repeats the fault, because its alarm ends when it is no longer reported. */
    private void reportRetained() {
        if (retained != null && System.nanoTime() - retainedReported >= FailureReporter.REPORT_INTERVAL.toNanos()) {
            retainedReported = System.nanoTime();
            producer.send(new ProducerRecord<>(
                    Topics.FAULTS, "provisioner", retained.fault().toBytes()));
        }
    }

    /** Commits an offset only to record that the devices of this Kafka were provisioned at this IoT Agent. */
    private void recordProvisioned() {
        if (provisioning.isSettled() && !provisionedRecorded) {
            Map<TopicPartition, OffsetAndMetadata> offsets = new HashMap<>();
            consumer.assignment()
                    .forEach(partition ->
                            offsets.put(partition, new OffsetAndMetadata(consumer.position(partition), agent)));
            consumer.commitSync(offsets);
            provisionedRecorded = true;
        }
    }

    private RemovalGuard.Origin origin(Collection<TopicPartition> partitions) {
        try (Admin admin = Admin.create(client)) {
            Uuid topic = admin.describeTopics(List.of(Topics.DEVICES))
                    .topicNameValues()
                    .get(Topics.DEVICES)
                    .get(ADMIN_TIMEOUT.toMillis(), TimeUnit.MILLISECONDS)
                    .topicId();
            boolean provisioned = consumer.committed(Set.copyOf(partitions)).values().stream()
                    .anyMatch(committed ->
                            committed != null && committed.metadata().equals(agent));
            return new RemovalGuard.Origin(Uuid.ZERO_UUID.equals(topic) ? "" : topic.toString(), provisioned);
        } catch (ExecutionException | TimeoutException e) {
            throw new KafkaException(Topics.DEVICES + " cannot be described: " + FailureText.of(e), e);
        } catch (InterruptedException e) {
            throw new InterruptException(e);
        }
    }

    private final class Assignment implements ConsumerRebalanceListener {
        @Override
        public void onPartitionsAssigned(Collection<TopicPartition> partitions) {
            if (partitions.isEmpty()) {
                return;
            }
            active = true;
            desired.clear();
            failures.clear();
            connections.reset(publishedConnections());
            provisioning.reset(origin(partitions));
            retained = null;
            provisionedRecorded = false;
            closeLists();
            lists = CommittedReader.open(client, Topics.MISSION_DEVICES);
            consumer.seekToBeginning(partitions);
            unread.putAll(consumer.endOffsets(partitions));
        }

        @Override
        public void onPartitionsRevoked(Collection<TopicPartition> partitions) {
            if (!partitions.isEmpty()) {
                active = false;
                closeLists();
                unread.clear();
            }
        }
    }
}
