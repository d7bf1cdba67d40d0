package io.furrow.analytics.position;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.StringCodec;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link Device}. */
public final class DeviceSerializer extends VersionedSerializer<Device> {
    private static final long serialVersionUID = 1L;
    /** Topic, identity. */
    private static final int VERSION = 1;

    @Override
    public Class<Device> type() {
        return Device.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Device device, DataOutputView out) throws IOException {
        StringCodec.write(device.topic(), out);
        StringCodec.write(device.identity(), out);
    }

    @Override
    public Device read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new Device(StringCodec.read(in), StringCodec.read(in));
    }
}
