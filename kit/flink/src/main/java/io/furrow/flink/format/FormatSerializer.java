package io.furrow.flink.format;

import java.io.IOException;

import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

/** Flink's view of a {@link Format}: reads one version of it, writes the newest. */
final class FormatSerializer<T> extends TypeSerializer<T> {
    private static final long serialVersionUID = 1L;

    private final Format<T> format;
    private final int reads;

    FormatSerializer(Format<T> format, int reads) {
        this.format = format;
        this.reads = reads;
    }

    Format<T> format() {
        return format;
    }

    @Override
    public boolean isImmutableType() {
        return format.isImmutable();
    }

    @Override
    public TypeSerializer<T> duplicate() {
        return this;
    }

    /** None: no value of a format is ever filled in place. */
    @Override
    public T createInstance() {
        return null;
    }

    @Override
    public T copy(T from) {
        return format.copy(from);
    }

    @Override
    public T copy(T from, T reuse) {
        return format.copy(from);
    }

    @Override
    public int getLength() {
        return -1;
    }

    @Override
    public void serialize(T value, DataOutputView out) throws IOException {
        format.write(value, out);
    }

    @Override
    public T deserialize(DataInputView in) throws IOException {
        return format.read(reads, in);
    }

    @Override
    public T deserialize(T reuse, DataInputView in) throws IOException {
        return format.read(reads, in);
    }

    @Override
    public void copy(DataInputView in, DataOutputView out) throws IOException {
        format.write(format.read(reads, in), out);
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof FormatSerializer<?> serializer
                && serializer.format.getClass() == format.getClass()
                && serializer.reads == reads;
    }

    @Override
    public int hashCode() {
        return 31 * format.getClass().hashCode() + reads;
    }

    @Override
    public TypeSerializerSnapshot<T> snapshotConfiguration() {
        return new FormatSnapshot<>(format);
    }
}
