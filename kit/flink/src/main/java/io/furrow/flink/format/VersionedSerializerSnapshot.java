package io.furrow.flink.format;

import java.io.IOException;

import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSchemaCompatibility;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;
import org.apache.flink.util.InstantiationUtil;

/** The snapshot of a {@link VersionedTypeSerializer} in a savepoint: the class and version of the serializer that wrote the state. */
public final class VersionedSerializerSnapshot<T> implements TypeSerializerSnapshot<T> {
    /** Class name of the serializer, its version. */
    private static final int VERSION = 1;

    private VersionedSerializer<T> format;
    private int written;

    /** For Flink, which calls {@link #readSnapshot} next. */
    public VersionedSerializerSnapshot() {}

    VersionedSerializerSnapshot(VersionedSerializer<T> versionedSerializer) {
        this.format = versionedSerializer;
        this.written = versionedSerializer.version();
    }

    @Override
    public int getCurrentVersion() {
        return VERSION;
    }

    @Override
    public void writeSnapshot(DataOutputView out) throws IOException {
        out.writeUTF(format.getClass().getName());
        out.writeInt(written);
    }

    @Override
    @SuppressWarnings("unchecked") // the name was written by a format of T
    public void readSnapshot(int readVersion, DataInputView in, ClassLoader loader) throws IOException {
        if (readVersion != VERSION) {
            throw new IOException("a format's snapshot of version " + readVersion + " is unknown, known is " + VERSION
                    + "; use the release that wrote it, or a newer one");
        }
        Class<?> type = InstantiationUtil.resolveClassByName(in, loader);
        format = (VersionedSerializer<T>) InstantiationUtil.instantiate(type);
        written = in.readInt();
        if (written < 1 || written > format.version()) {
            throw format.unknown(written);
        }
    }

    @Override
    public TypeSerializer<T> restoreSerializer() {
        return new VersionedTypeSerializer<>(format, written);
    }

    @Override
    public TypeSerializerSchemaCompatibility<T> resolveSchemaCompatibility(TypeSerializerSnapshot<T> old) {
        if (!(old instanceof VersionedSerializerSnapshot<T> before) || before.format.getClass() != format.getClass()) {
            return TypeSerializerSchemaCompatibility.incompatible();
        }
        return before.written == written
                ? TypeSerializerSchemaCompatibility.compatibleAsIs()
                : TypeSerializerSchemaCompatibility.compatibleAfterMigration();
    }
}
