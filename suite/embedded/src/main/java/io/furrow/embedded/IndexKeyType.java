package io.furrow.embedded;

import java.nio.ByteBuffer;

import de.bwaldvogel.mongo.backend.KeyValue;
import org.h2.mvstore.DataUtils;
import org.h2.mvstore.WriteBuffer;
import org.h2.mvstore.type.BasicDataType;
import org.h2.mvstore.type.ObjectDataType;

/** Serializes keys of an index value by value, in comparable order. Java objects would be serialized for each comparison. */
final class IndexKeyType extends BasicDataType<KeyValue> {
    private static final int HEAP_OVERHEAD = 64;

    private final ObjectDataType values = new ObjectDataType();

    @Override
    public KeyValue[] createStorage(int size) {
        return new KeyValue[size];
    }

    @Override
    public int compare(KeyValue a, KeyValue b) {
        int order = Integer.compare(a.size(), b.size());
        for (int index = 0; order == 0 && index < a.size(); index++) {
            order = values.compare(a.get(index), b.get(index));
        }
        return order;
    }

    @Override
    public int getMemory(KeyValue key) {
        int memory = HEAP_OVERHEAD;
        for (Object value : key) {
            memory += values.getMemory(value);
        }
        return memory;
    }

    @Override
    public void write(WriteBuffer out, KeyValue key) {
        out.putVarInt(key.size());
        key.forEach(value -> values.write(out, value));
    }

    @Override
    public KeyValue read(ByteBuffer in) {
        Object[] read = new Object[DataUtils.readVarInt(in)];
        for (int index = 0; index < read.length; index++) {
            read[index] = values.read(in);
        }
        return new KeyValue(read);
    }
}
