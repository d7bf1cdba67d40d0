package io.furrow.flink.format;

import java.io.IOException;
import java.io.Serializable;
import java.lang.reflect.Type;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.TypeInfoFactory;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

/**
 * Serializes values of one type, which names it as its {@code @TypeInfo}. A serializer has no state and a public constructor
 * without parameters, by which it is restored from a savepoint; its class is never renamed. The serializer of a key type stays at
 * version 1: Flink treats state with other keys as another state, and restores none.
 *
 * @param <T> the type of values; never null
 */
public abstract class VersionedSerializer<T> extends TypeInfoFactory<T> implements Serializable {
    private static final long serialVersionUID = 1L;

    public abstract Class<T> type();

    /** The newest version, used for writing. The constant's comment describes the content. */
    public abstract int version();

    public abstract void write(T value, DataOutputView out) throws IOException;

    /**
     * @param version in which the value was written, 1 to {@link #version}
     * @throws IOException also if the bytes are not a value of that version
     */
    public abstract T read(int version, DataInputView in) throws IOException;

    /** Writes a value that is part of another one, after its own version, which is independent of the whole's. */
    public final void writePart(T value, DataOutputView out) throws IOException {
        out.writeByte(version());
        write(value, out);
    }

    /** Reads what {@link #writePart} wrote. */
    public final T readPart(DataInputView in) throws IOException {
        return read(in.readUnsignedByte(), in);
    }

    /** A value that shares no mutable state with the given one; the same if the type is immutable. */
    public T copy(T value) {
        return value;
    }

    /** Whether {@link #copy} returns its argument. */
    public boolean isImmutable() {
        return true;
    }

    /** The exception for an unknown version. */
    protected final IOException unknown(int version) {
        return new IOException(type().getSimpleName() + " was written in version " + version + ", this release writes "
                + version() + "; use the release that wrote it, or start without the savepoint");
    }

    @Override
    public final TypeInformation<T> createTypeInfo(Type type, Map<String, TypeInformation<?>> parameters) {
        return new VersionedTypeInfo<>(this);
    }
}
