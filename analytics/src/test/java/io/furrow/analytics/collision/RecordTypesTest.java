package io.furrow.analytics.collision;

import java.util.Map;

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

import static org.assertj.core.api.Assertions.assertThat;

class RecordTypesTest {
    private static final PositionFix FIX = Fixes.carriedBy("b", Fixes.at("a", 40.5, -3.25, 1000));

    static Object[] records() {
        return new Object[] {
            FIX,
            new CellUpdate(-7, 1000, Presence.HALO, FIX),
            new Sighting(FIX, FIX, 1000, -1),
            new Encounter(Phase.ENDED, FIX, FIX, 4.5, 1.5, 500, 1000),
            new Cell(Map.of(FIX.identity(), Member.of(FIX, true))),
            Member.of(FIX, false),
            new Meeting(500, 1.5, 1000),
            new Course(new Encounter(Phase.STARTED, FIX, FIX, 4.5, 1.5, 500, 1000), true, 900),
            new Crowd(Map.of("a", "a"), 3, true, 1000),
            new CellOverflow(FIX, -7, 40, -3, 9, 4, 1, 1000)
        };
    }

    @ParameterizedTest
    @MethodSource("records")
    void goThroughFlinksOwnSerializer(Object written) throws Exception {
        assertThat(copied(written)).isEqualTo(written);
    }

    @org.junit.jupiter.api.Test
    void tracksGoThroughFlinksOwnSerializerWithAndWithoutAPosition() throws Exception {
        Track track = copied(new Track(FIX, new long[] {3, -4}));
        assertThat(track.last()).isEqualTo(FIX);
        assertThat(track.cells()).containsExactly(3, -4);
        assertThat(copied(Track.NOWHERE).isNowhere()).isTrue();
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
