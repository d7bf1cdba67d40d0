package io.furrow.provisioner;

import java.util.Optional;

import io.furrow.model.device.DeviceConnection.UnreadablePayload;

/** What an IoT Agent noticed of measures. An agent of FIWARE only writes it into its log, so nobody says it there. */
public interface MeasureReports {
    MeasureReports NONE = (apiKey, device) -> Optional.empty();

    /** What it could not read of a device; empty if there was nothing. Safe from all threads. */
    Optional<UnreadablePayload> unreadable(String apiKey, String device);
}
