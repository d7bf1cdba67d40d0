package io.furrow.analytics.presence;

import io.furrow.analytics.Serializers;
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
        Serializers.assertPlain(written);
    }
}
