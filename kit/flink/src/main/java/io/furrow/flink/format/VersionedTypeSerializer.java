package io.furrow.flink.format;

import java.io.IOException;

import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

/** Adapts a {@link VersionedSerializer} to Flink: reads one version of it, writes the newest. */
final class VersionedTypeSerializer<T> extends TypeSerializer<T> {
    private static final long serialVersionUID = 1L;

    private final VersionedSerializer<T> versionedSerializer;
    private final int reads;

    VersionedTypeSerializer(VersionedSerializer<T> versionedSerializer, int reads) {
        this.versionedSerializer = versionedSerializer;
        this.reads = reads;
    }

    VersionedSerializer<T> format() {
        return versionedSerializer;
    }

    @Override
    public boolean isImmutableType() {
        return versionedSerializer.isImmutable();
    }

    @Override
    public TypeSerializer<T> duplicate() {
        return this;
    }

    /** Null: values are never filled in place. */
    @Override
    public T createInstance() {
        return null;
    }

    @Override
    public T copy(T from) {
        return versionedSerializer.copy(from);
    }

    @Override
    public T copy(T from, T reuse) {
        return versionedSerializer.copy(from);
    }

    @Override
    public int getLength() {
        return -1;
    }

    @Override
    public void serialize(T value, DataOutputView out) throws IOException {
        versionedSerializer.write(value, out);
    }

    @Override
    public T deserialize(DataInputView in) throws IOException {
        return versionedSerializer.read(reads, in);
    }

    @Override
    public T deserialize(T reuse, DataInputView in) throws IOException {
        return versionedSerializer.read(reads, in);
    }

    @Override
    public void copy(DataInputView in, DataOutputView out) throws IOException {
        versionedSerializer.write(versionedSerializer.read(reads, in), out);
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof VersionedTypeSerializer<?> serializer
                && serializer.versionedSerializer.getClass() == versionedSerializer.getClass()
                && serializer.reads == reads;
    }

    @Override
    public int hashCode() {
        return 31 * versionedSerializer.getClass().hashCode() + reads;
    }

    @Override
    public TypeSerializerSnapshot<T> snapshotConfiguration() {
        return new VersionedSerializerSnapshot<>(versionedSerializer);
    }
}
