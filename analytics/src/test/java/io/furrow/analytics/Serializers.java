package io.furrow.analytics;

import org.apache.flink.api.common.serialization.SerializerConfigImpl;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.java.typeutils.runtime.PojoSerializer;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;

import static org.assertj.core.api.Assertions.assertThat;

/** Sends records through the serializers that Flink takes for them. */
public final class Serializers {
    private Serializers() {}

    public static <T> T copied(T written) throws Exception {
        TypeSerializer<T> serializer = of(written);
        DataOutputSerializer out = new DataOutputSerializer(256);
        serializer.serialize(written, out);
        DataInputDeserializer in = new DataInputDeserializer(out.getCopyOfBuffer());
        T read = serializer.deserialize(in);
        assertThat(in.available()).isZero();
        return read;
    }

    public static <T> TypeSerializer<T> of(T written) {
        // Refuses every type that would fall to Kryo.
        Configuration strict = new Configuration().set(PipelineOptions.GENERIC_TYPES, false);
        @SuppressWarnings("unchecked")
        Class<T> type = (Class<T>) written.getClass();
        return TypeInformation.of(type).createSerializer(new SerializerConfigImpl(strict));
    }

    /** Asserts that a record comes back from Flink's own serializer. */
    public static void assertPlain(Object written) throws Exception {
        assertThat(copied(written)).isEqualTo(written);
        assertThat(of(written)).isInstanceOf(PojoSerializer.class);
    }
}
