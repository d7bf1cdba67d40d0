package io.furrow.flink;

import java.lang.reflect.Type;
import java.util.Map;

import org.apache.flink.api.common.serialization.SerializerConfig;
import org.apache.flink.api.common.typeinfo.TypeInfoFactory;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;

/** Tells Flink to use {@link TopicRecordSerializer}. */
final class TopicRecordType extends TypeInformation<TopicRecord> {
    private static final long serialVersionUID = 1L;

    /** Named by {@link TopicRecord}. */
    public static final class Factory extends TypeInfoFactory<TopicRecord> {
        @Override
        public TypeInformation<TopicRecord> createTypeInfo(Type type, Map<String, TypeInformation<?>> parameters) {
            return new TopicRecordType();
        }
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
    public Class<TopicRecord> getTypeClass() {
        return TopicRecord.class;
    }

    @Override
    public boolean isKeyType() {
        return false;
    }

    @Override
    public TypeSerializer<TopicRecord> createSerializer(SerializerConfig config) {
        return TopicRecordSerializer.INSTANCE;
    }

    @Override
    public boolean canEqual(Object other) {
        return other instanceof TopicRecordType;
    }

    @Override
    public boolean equals(Object other) {
        return canEqual(other);
    }

    @Override
    public int hashCode() {
        return TopicRecordType.class.hashCode();
    }

    @Override
    public String toString() {
        return TopicRecord.class.getSimpleName();
    }
}
