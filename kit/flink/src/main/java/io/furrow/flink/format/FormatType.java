package io.furrow.flink.format;

import org.apache.flink.api.common.serialization.SerializerConfig;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;

/** The type information of what a {@link Format} writes; they are keys where they say what makes them equal. */
public final class FormatType<T> extends TypeInformation<T> {
    private static final long serialVersionUID = 1L;

    private final Format<T> format;

    public FormatType(Format<T> format) {
        this.format = format;
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
        return format.type();
    }

    @Override
    public boolean isKeyType() {
        return true;
    }

    @Override
    public TypeSerializer<T> createSerializer(SerializerConfig config) {
        return new FormatSerializer<>(format, format.version());
    }

    @Override
    public String toString() {
        return format.type().getSimpleName() + " in version " + format.version();
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof FormatType<?> type && type.format.getClass() == format.getClass();
    }

    @Override
    public int hashCode() {
        return format.getClass().hashCode();
    }

    @Override
    public boolean canEqual(Object other) {
        return other instanceof FormatType<?>;
    }
}
