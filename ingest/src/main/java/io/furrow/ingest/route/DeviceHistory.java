package io.furrow.ingest.route;

import java.util.List;

import io.furrow.flink.device.DeviceLookup;
import io.furrow.flink.device.DeviceVersions;
import io.furrow.model.device.DeviceVersion;

/**
 * The versions of a device as savepoints of this job hold them.
 *
 * @param versions as in {@link DeviceVersions}
 */
public record DeviceHistory(List<DeviceVersion> versions) {
    /** To and from the state. */
    static final class Form implements DeviceLookup.StateCodec<DeviceHistory> {
        private static final long serialVersionUID = 1L;

        @Override
        public DeviceVersions read(DeviceHistory held) {
            return new DeviceVersions(held.versions());
        }

        @Override
        public DeviceHistory held(DeviceVersions versions) {
            return new DeviceHistory(versions.versions());
        }
    }
}
