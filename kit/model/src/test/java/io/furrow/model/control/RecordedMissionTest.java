package io.furrow.model.control;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class RecordedMissionTest {
    @Test
    void readsBackARecord() throws Exception {
        RecordedMission mission = new RecordedMission("weeding", 1000, 2000, 5);

        assertThat(new String(mission.toBytes(), UTF_8))
                .isEqualTo("{\"mission\":\"weeding\",\"first\":1000,\"last\":2000,\"events\":5}");
        assertThat(RecordedMission.read(mission.toBytes())).isEqualTo(mission);
    }

    @Test
    void readsARecordWithoutANumberOfEvents() throws Exception {
        assertThat(RecordedMission.read("{\"mission\":\"m\",\"first\":1,\"last\":2}".getBytes(UTF_8)))
                .isEqualTo(new RecordedMission("m", 1, 2, 0));
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"7", "{", "{\"mission\":\"m\",\"first\":1}", "{\"mission\":\"m\",\"first\":1,\"last\":\"2\"}"})
    void rejectsInvalidRecords(String json) {
        assertThatThrownBy(() -> RecordedMission.read(json.getBytes(UTF_8))).isInstanceOf(UnreadableException.class);
    }
}
