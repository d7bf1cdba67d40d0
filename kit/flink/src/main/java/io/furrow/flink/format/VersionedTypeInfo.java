package io.furrow.flink.format;

import org.apache.flink.api.common.serialization.SerializerConfig;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;

/** The type information for a {@link VersionedSerializer}; values are keys if they define equality. */
public final class VersionedTypeInfo<T> extends TypeInformation<T> {
    private static final long serialVersionUID = 1L;

    private final VersionedSerializer<T> versionedSerializer;

    public VersionedTypeInfo(VersionedSerializer<T> versionedSerializer) {
        this.versionedSerializer = versionedSerializer;
    }

    @Override
    public boolean isBasicType() {
        return false;
    }

    @Override
    public boolean isTupleType() {
        return false;
    }

    @Override
    public int getArity() {
        return 1;
    }

    @Override
    public int getTotalFields() {
        return 1;
    }

    @Override
    public Class<T> getTypeClass() {
        return versionedSerializer.type();
    }

    @Override
    public boolean isKeyType() {
        return true;
    }

    @Override
    public TypeSerializer<T> createSerializer(SerializerConfig config) {
        return new VersionedTypeSerializer<>(versionedSerializer, versionedSerializer.version());
    }

    @Override
    public String toString() {
        return versionedSerializer.type().getSimpleName() + " in version " + versionedSerializer.version();
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof VersionedTypeInfo<?> type
                && type.versionedSerializer.getClass() == versionedSerializer.getClass();
    }

    @Override
    public int hashCode() {
        return versionedSerializer.getClass().hashCode();
    }

    @Override
    public boolean canEqual(Object other) {
        return other instanceof VersionedTypeInfo<?>;
    }
}
