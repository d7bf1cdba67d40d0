package io.furrow.control;

import java.util.Properties;

import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class ServiceTopicsTest {
    /** A start reads them whole, and a broker does not compact the active segment. */
    @Test
    void rollStatesThatAreRepeatedWithinMinutes() {
        assertThat(ServiceTopics.desired(ControlSettings.of(new Properties())))
                .filteredOn(topic -> "600000".equals(topic.configs().get("segment.ms")))
                .extracting(topic -> topic.name())
                .containsExactlyInAnyOrder(
                        Topics.DEVICES_HEALTH,
                        Topics.DEVICES_CONNECTION,
                        Topics.FAULTS,
                        Topics.RECORDINGS,
                        Topics.REPLAYS_STATUS);
    }
}
