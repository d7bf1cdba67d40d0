package io.furrow.provisioner;

import java.util.HashMap;
import java.util.Map;

import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;

/**
 * Reports devices that could not be provisioned on {@code service.devices.status}, once per desired state of a device
 * and not before the third attempt. It is tried further; once it is provisioned its host says that it runs.
 */
final class FailureReporter {
    static final int ATTEMPTS = 3;
    private static final Logger LOG = LoggerFactory.getLogger(FailureReporter.class);

    private final DesiredDeviceTable desired;
    private final Producer<String, byte[]> producer;
    private final Map<String, Count> refusals = new HashMap<>();
    private final Map<String, Count> absences = new HashMap<>();

    private record Count(long sequence, int attempts) {}

    FailureReporter(DesiredDeviceTable desired, Producer<String, byte[]> producer) {
        this.desired = desired;
        this.producer = producer;
    }

    void clear() {
        refusals.clear();
        absences.clear();
    }

    /** @param reasons by key; whatever is not among them is well */
    void refused(Map<String, String> reasons) {
        refusals.keySet().retainAll(reasons.keySet());
        reasons.forEach((key, reason) -> count(refusals, key, reason));
    }

    /** Of those that were wanted before nothing is said: they may well run. */
    void unavailable(String reason) {
        desired.all().keySet().stream().filter(desired::isFresh).toList().forEach(key -> count(absences, key, reason));
    }

    /** A step was done: the agent is not away, though it may be slow. */
    void reached() {
        absences.clear();
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
