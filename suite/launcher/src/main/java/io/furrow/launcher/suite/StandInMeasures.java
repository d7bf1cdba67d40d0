package io.furrow.launcher.suite;

import java.util.Optional;

import io.furrow.fiware.agent.MeasureHistory;
import io.furrow.model.device.DeviceConnection.UnreadablePayload;
import io.furrow.provisioner.MeasureReports;

/** Measures that the stand-in of the IoT Agent could not read. */
record StandInMeasures(MeasureHistory history) implements MeasureReports {
    @Override
    public Optional<UnreadablePayload> unreadable(String apiKey, String device) {
        return history.of(apiKey, device)
                .map(MeasureHistory.Received::ignored)
                .map(last -> new UnreadablePayload(last.count(), last.last(), last.reason(), last.payload()));
    }
}
