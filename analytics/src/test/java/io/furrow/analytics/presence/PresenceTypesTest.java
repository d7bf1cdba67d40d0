package io.furrow.analytics.presence;

import java.util.List;

import org.apache.flink.api.common.serialization.SerializerConfigImpl;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.java.typeutils.runtime.PojoSerializer;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

class PresenceTypesTest {
    private static final PositionFix FIX = Story.fix("d", 2, 3, 1000);
    private static final Visit STAY = new Visit("f", "North", "farm", 500, true, 900, Cause.SILENT, FIX);

    static Object[] records() {
        return new Object[] {
            STAY,
            new PresenceTransition(PresenceTransition.Phase.LEFT, STAY, 950),
            new PresenceState(FIX, 1000, List.of(STAY, STAY.back())),
            PresenceState.NOWHERE
        };
    }

    @ParameterizedTest
    @MethodSource("records")
    void goThroughFlinksOwnSerializer(Object written) throws Exception {
        assertThat(copied(written)).isEqualTo(written);
    }

    private static <T> T copied(T written) throws Exception {
        // Refuses every type that would fall to Kryo.
        Configuration strict = new Configuration().set(PipelineOptions.GENERIC_TYPES, false);
        @SuppressWarnings("unchecked")
        Class<T> type = (Class<T>) written.getClass();
        TypeSerializer<T> serializer = TypeInformation.of(type).createSerializer(new SerializerConfigImpl(strict));
        assertThat(serializer).isInstanceOf(PojoSerializer.class);
        DataOutputSerializer out = new DataOutputSerializer(256);
        serializer.serialize(written, out);
        DataInputDeserializer in = new DataInputDeserializer(out.getCopyOfBuffer());
        T read = serializer.deserialize(in);
        assertThat(in.available()).isZero();
        return read;
    }
}
