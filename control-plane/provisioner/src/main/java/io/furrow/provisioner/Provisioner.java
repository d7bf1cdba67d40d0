package io.furrow.provisioner;

import java.time.Clock;

import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.SupervisedWorker;

/**
 * Provisions the devices of {@code service.devices} at the IoT Agent and at the MQTT brokers, and removes all others.
 * Of several instances one is at work, another takes over when it dies. Whatever makes it fail, it begins again.
 */
public final class Provisioner implements AutoCloseable {
    private final SupervisedWorker worker;
    private volatile String detail = "starts";

    private Provisioner(ProvisioningSettings settings) {
        this.worker = new SupervisedWorker("provisioner", Clock.systemUTC())
                .start(self -> provision(settings, self), () -> detail);
    }

    /** Begins; {@code service.devices} must be there, {@code ControlPlane} makes it. */
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

    /** For a health page: it works as long as it reads what is requested, though the IoT Agent may be unavailable. */
    public ComponentStatus status() {
        return worker.status();
    }

    /** Finishes the request that is under way, and leaves the rest to another instance or the next start. */
    @Override
    public void close() {
        worker.close();
    }
}
