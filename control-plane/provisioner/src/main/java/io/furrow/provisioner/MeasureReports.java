package io.furrow.provisioner;

import java.util.Optional;

import io.furrow.model.device.DeviceConnection.UnreadablePayload;

/** Reports measures that an IoT Agent could not read. FIWARE's agent writes this only to its log, so it has no implementation there. */
public interface MeasureReports {
    MeasureReports NONE = (apiKey, device) -> Optional.empty();

    /** Returns the unreadable payloads of a device; empty if there were none. Thread-safe. */
    Optional<UnreadablePayload> unreadable(String apiKey, String device);
}
