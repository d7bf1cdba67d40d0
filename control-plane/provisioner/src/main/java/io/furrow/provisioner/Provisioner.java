package io.furrow.provisioner;

import java.time.Clock;

import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.SupervisedWorker;

/**
 * Provisions the devices of {@code service.devices} at the IoT Agent and at the MQTT brokers, and removes all others.
 * One of several instances is active; another takes over when it fails. The worker restarts after any failure.
 */
public final class Provisioner implements AutoCloseable {
    private final SupervisedWorker worker;
    private volatile String detail = "starts";

    private Provisioner(ProvisioningSettings settings) {
        this.worker = new SupervisedWorker("provisioner", Clock.systemUTC())
                .start(self -> provision(settings, self), () -> detail);
    }

    /** Starts the provisioner; {@code service.devices} must exist, {@code ControlPlane} creates it. */
    public static Provisioner start(ProvisioningSettings settings) {
        return new Provisioner(settings);
    }

    private void provision(ProvisioningSettings settings, SupervisedWorker self) throws InterruptedException {
        try (ProvisioningWorker loop = new ProvisioningWorker(settings)) {
            while (!self.isClosing()) {
                loop.next();
                self.succeeded();
                detail = loop.detail();
            }
        }
    }

    /** Returns the status for a health page: up as long as requests are read, even if the IoT Agent is unavailable. */
    public ComponentStatus status() {
        return worker.status();
    }

    /** Finishes the current request and leaves the rest to another instance or the next start. */
    @Override
    public void close() {
        worker.close();
    }
}
