package io.furrow.launcher;

import java.io.IOException;
import java.net.URI;
import java.time.Duration;
import java.time.Instant;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.FarmWatch;
import io.furrow.control.WatchOptions;
import io.furrow.control.provisioning.Provisioner;
import io.furrow.control.provisioning.ProvisioningSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;

/** The control plane in this JVM: managers, REST API, watch over the farm, and who provisions the devices of missions. */
final class ControlService implements AutoCloseable {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final Duration BETWEEN_LOOKS = Duration.ofMillis(50);

    private final ControlSettings settings;
    private final Parts parts = new Parts();
    private ControlPlane managers;

    ControlService(ControlSettings settings) {
        this.settings = settings;
    }

    /**
     * Starts the managers and waits until they answer.
     *
     * @return the state in which they are then
     */
    String startManagers() throws IOException {
        managers = parts.add("managers", ControlPlane.start(settings));
        Instant end = Instant.now().plus(PATIENCE);
        while (!managers.isHealthy()) {
            if (Instant.now().isAfter(end)) {
                throw new SuiteNotStartedException("The control plane is %s after %d s; see furrow.log"
                        .formatted(managers.state(), PATIENCE.toSeconds()));
            }
            Pause.of(BETWEEN_LOOKS);
        }
        return managers.state();
    }

    /**
     * Begins to take commands, and to act.
     *
     * @param provisioning null where no devices are provisioned
     * @return base of the REST API
     */
    URI serve(RestSettings rest, WatchOptions watch, ProvisioningSettings provisioning) throws IOException {
        parts.add("farm watch", FarmWatch.start(settings, watch));
        RestApi api = parts.add("REST API", RestApi.start(settings, rest, managers::state));
        if (provisioning != null) {
            parts.add("provisioner", Provisioner.start(provisioning));
        }
        return api.uri();
    }

    @Override
    public void close() {
        parts.close();
    }
}
