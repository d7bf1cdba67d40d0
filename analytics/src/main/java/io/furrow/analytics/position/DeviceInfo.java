package io.furrow.analytics.position;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Arrays;

import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.SharedByTasks;
import io.furrow.flink.format.StringCodec;
import io.furrow.model.event.FiwareScope;

/**
 * The common part of a device's positions. Unknown texts are empty, never null.
 *
 * <p>It is written as one block of bytes and read by comparing that with recently read blocks: the same devices recur, and
 * decoding their texts each time costs more than all processing of a position.
 */
public final class DeviceInfo {
    private static final int SLOT_BITS = 19;
    /** Ways of a slot: of 100,000 devices one in 1,000 finds all of them taken. */
    private static final int WAYS = 4;

    private static final int SPREAD = 0x9E3779B9;
    private static final SharedByTasks<DeviceInfo[]> KNOWN = new SharedByTasks<>(() -> new DeviceInfo[1 << SLOT_BITS]);

    private final Device device;
    private final String id;
    private final String type;
    private final String mission;
    private final String carrier;
    private final byte[] block;
    private final String name;

    private DeviceInfo(Device device, String id, String type, String mission, String carrier, byte[] block) {
        this.device = device;
        this.id = id;
        this.type = type;
        this.mission = mission;
        this.carrier = carrier;
        this.block = block;
        this.name = FiwareScope.ofIdentity(device.identity()).identity(id);
    }

    /**
     * @param device topic and identity
     * @param id the entity id
     * @param type the entity type
     * @param mission the mission it works for
     * @param carrier tenant, service path and id of the device that carries it
     */
    public static DeviceInfo of(Device device, String id, String type, String mission, String carrier) {
        int slot = slot(device.hashCode());
        DeviceInfo[] all = KNOWN.get();
        for (int way = 0; way < WAYS; way++) {
            DeviceInfo known = all[slot ^ way];
            if (known != null && known.has(device, id, type, mission, carrier)) {
                return known;
            }
        }
        return keep(
                new DeviceInfo(device, id, type, mission, carrier, block(device, id, type, mission, carrier)),
                slot,
                all);
    }

    private boolean has(Device device, String id, String type, String mission, String carrier) {
        return this.device.equals(device)
                && this.id.equals(id)
                && this.type.equals(type)
                && this.mission.equals(mission)
                && this.carrier.equals(carrier);
    }

    /** Uses an empty way, else the first. If two threads race for one, the later wins; either is right. */
    private static DeviceInfo keep(DeviceInfo reporter, int slot, DeviceInfo[] all) {
        int way = WAYS - 1;
        while (way > 0 && all[slot ^ way] != null) {
            way--;
        }
        all[slot ^ way] = reporter;
        return reporter;
    }

    private static int slot(int hash) {
        return hash * SPREAD >>> Integer.SIZE - SLOT_BITS;
    }

    /** The texts in their order; an id at the end of the identity is written as its length, any other after a -1. */
    private static byte[] block(Device device, String id, String type, String mission, String carrier) {
        DataOutputSerializer out = new DataOutputSerializer(Byte.MAX_VALUE);
        try {
            StringCodec.write(device.topic(), out);
            StringCodec.write(device.identity(), out);
            boolean isEnd = device.identity().endsWith(id);
            out.writeInt(isEnd ? id.length() : -1);
            if (!isEnd) {
                StringCodec.write(id, out);
            }
            StringCodec.write(type, out);
            StringCodec.write(mission, out);
            StringCodec.write(carrier, out);
        } catch (IOException e) {
            throw new UncheckedIOException(e); // in memory, it cannot fail
        }
        return out.getCopyOfBuffer();
    }

    void write(DataOutputView out) throws IOException {
        out.writeInt(device.hashCode());
        out.writeInt(block.length);
        out.write(block);
    }

    static DeviceInfo read(DataInputView in) throws IOException {
        int slot = slot(in.readInt());
        byte[] block = new byte[in.readInt()];
        in.readFully(block);
        DeviceInfo[] all = KNOWN.get();
        for (int way = 0; way < WAYS; way++) {
            DeviceInfo known = all[slot ^ way];
            if (known != null && Arrays.equals(known.block, block)) {
                return known;
            }
        }
        return keep(decoded(block), slot, all);
    }

    private static DeviceInfo decoded(byte[] block) throws IOException {
        DataInputDeserializer in = new DataInputDeserializer(block);
        Device device = new Device(StringCodec.read(in), StringCodec.read(in));
        int length = in.readInt();
        String identity = device.identity();
        String id =
                length < 0 ? StringCodec.read(in) : StringCodec.shared(identity.substring(identity.length() - length));
        return new DeviceInfo(device, id, StringCodec.read(in), StringCodec.read(in), StringCodec.read(in), block);
    }

    Device device() {
        return device;
    }

    public String id() {
        return id;
    }

    String name() {
        return name;
    }

    public String type() {
        return type;
    }

    public String mission() {
        return mission;
    }

    public String carrier() {
        return carrier;
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof DeviceInfo reporter && Arrays.equals(block, reporter.block);
    }

    @Override
    public int hashCode() {
        return device.hashCode();
    }

    @Override
    public String toString() {
        return "%s, id %s, type %s, mission %s, carrier %s".formatted(device, id, type, mission, carrier);
    }
}
