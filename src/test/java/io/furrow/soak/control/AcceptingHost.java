package io.furrow.soak.control;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.CommittedState;

/** Reports the desired state of each device at once, without running devices. */
final class AcceptingHost implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(50);

    private final String bootstrapServers;
    private final RequestSender sender;
    private volatile boolean closed;

    /** The topics must exist. */
    AcceptingHost(String bootstrapServers, RequestSender sender) {
        this.bootstrapServers = bootstrapServers;
        this.sender = sender;
        Thread thread = new Thread(this::readDevices, "accepting-host");
        thread.setDaemon(true);
        thread.start();
    }

    private void readDevices() {
        try (KafkaConsumer<String, byte[]> consumer = CommittedState.consumer(bootstrapServers)) {
            CommittedState.assign(consumer, List.of(Topics.DEVICES));
            while (!closed) {
                consumer.poll(POLL).forEach(this::report);
            }
        }
    }

    private void report(ConsumerRecord<String, byte[]> record) {
        try {
            DesiredDevice device = record.value() == null ? null : DesiredDevice.read(record.value());
            if (device != null && device.simulated()) {
                DeviceStatus.State state = device.running() ? DeviceStatus.State.RUNNING : DeviceStatus.State.STOPPED;
                DeviceStatus status = new DeviceStatus(device.version().sequence(), state, null);
                sender.write(Topics.DEVICES_STATUS, record.key(), status.toBytes());
            }
        } catch (UnreadableException e) {
            throw new IllegalStateException("the control plane wrote what cannot be read under " + record.key(), e);
        }
    }

    @Override
    public void close() {
        closed = true;
    }
}
