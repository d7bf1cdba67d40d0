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
 * How the values of one type are written; the type names it as its {@code @TypeInfo}. A format has no state and a public
 * constructor without parameters, by which it is found again when a savepoint is read. Its class is never renamed. The format of a
 * type by which state is keyed stays at version 1: Flink takes state with other keys for another state, and restores none.
 *
 * @param <T> what is written; never null
 */
public abstract class VersionedSerializer<T> extends TypeInfoFactory<T> implements Serializable {
    private static final long serialVersionUID = 1L;

    public abstract Class<T> type();

    /** The newest version, which is the one that is written. Says in its constant what it holds. */
    public abstract int version();

    public abstract void write(T value, DataOutputView out) throws IOException;

    /**
     * @param version in which the value was written, 1 to {@link #version}
     * @throws IOException also where the bytes are no value of that version
     */
    public abstract T read(int version, DataInputView in) throws IOException;

    /** Writes a value that is part of another one: behind its version, so that it may have another than the whole. */
    public final void writePart(T value, DataOutputView out) throws IOException {
        out.writeByte(version());
        write(value, out);
    }

    /** Reads what {@link #writePart} wrote. */
    public final T readPart(DataInputView in) throws IOException {
        return read(in.readUnsignedByte(), in);
    }

    /** A value that shares nothing changeable with the given one; the same where the type cannot be changed. */
    public T copy(T value) {
        return value;
    }

    /** Whether {@link #copy} returns its argument. */
    public boolean isImmutable() {
        return true;
    }

    /** The refusal of a version that the format does not know. */
    protected final IOException unknown(int version) {
        return new IOException(type().getSimpleName() + " was written in version " + version + ", this release writes "
                + version() + "; use the release that wrote it, or start without the savepoint");
    }

    @Override
    public final TypeInformation<T> createTypeInfo(Type type, Map<String, TypeInformation<?>> parameters) {
        return new VersionedTypeInfo<>(this);
    }
}
