package io.furrow.provisioner;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.function.LongSupplier;

import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.control.Fault;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;

/**
 * Reports devices that could not be provisioned on {@code service.devices.status}: once per desired state of a device,
 * after the third attempt. Retries continue; once the device is provisioned, its host reports it as running.
 * Reports undecided devices as a fault.
 */
final class FailureReporter {
    static final int ATTEMPTS = 3;
    /** Interval of a fault, whose alarm ends when it is no longer reported. */
    static final Duration REPORT_INTERVAL = Duration.ofMinutes(1);

    private static final Logger LOG = LoggerFactory.getLogger(FailureReporter.class);

    private final DesiredDeviceTable desired;
    private final Producer<String, byte[]> producer;
    private final Map<String, Count> rejections = new HashMap<>();
    private final Map<String, Count> outages = new HashMap<>();

    private final LongSupplier nanos;
    private long undecidedReported;

    private record Count(long sequence, int attempts) {}

    FailureReporter(DesiredDeviceTable desired, Producer<String, byte[]> producer, LongSupplier nanos) {
        this.desired = desired;
        this.producer = producer;
        this.nanos = nanos;
        this.undecidedReported = nanos.getAsLong();
    }

    void clear() {
        rejections.clear();
        outages.clear();
    }

    /** Counts rejections. @param reasons by key; other devices have succeeded */
    void rejected(Map<String, String> reasons) {
        rejections.keySet().retainAll(reasons.keySet());
        reasons.forEach((key, reason) -> count(rejections, key, reason));
    }

    /** Counts failed attempts for new devices only: others may be running. */
    void unavailable(String reason) {
        desired.all().keySet().stream().filter(desired::isFresh).toList().forEach(key -> count(outages, key, reason));
    }

    /** Called after a completed step: the agent is available. */
    void available() {
        outages.clear();
    }

    /** Reports undecided devices; the first report waits too, because a device's record may come before its list. */
    void undecided() {
        long now = nanos.getAsLong();
        if (desired.undecidedKeys().isEmpty()) {
            undecidedReported = now;
        } else if (now - undecidedReported >= REPORT_INTERVAL.toNanos()) {
            undecidedReported = now;
            Fault fault = desired.undecidedFault();
            LOG.warn(fault.text());
            producer.send(new ProducerRecord<>(Topics.FAULTS, "provisioner devices", fault.toBytes()));
        }
    }

    private void count(Map<String, Count> counts, String key, String reason) {
        DesiredDevice device = desired.all().get(key);
        long sequence = device.version().sequence();
        Count before = counts.get(key);
        int attempts = before == null || before.sequence() != sequence ? 1 : before.attempts() + 1;
        counts.put(key, new Count(sequence, attempts));
        if (attempts == ATTEMPTS) {
            DeviceStatus status = new DeviceStatus(sequence, DeviceStatus.State.FAILED, "not provisioned: " + reason);
            producer.send(new ProducerRecord<>(Topics.DEVICES_STATUS, key, status.toBytes()), (sent, failure) -> {
                if (failure != null) {
                    LOG.warn("could not report that device {} is not provisioned", key, failure);
                }
            });
        }
    }
}
