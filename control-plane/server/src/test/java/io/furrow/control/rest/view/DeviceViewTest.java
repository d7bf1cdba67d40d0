package io.furrow.control.rest.view;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class DeviceViewTest {
    private static final String KEY = "farm|/|r1";

    private final StateView view = new StateView();

    /** A device that has not reported has its desired type as type of its health. */
    @ParameterizedTest
    @CsvSource({
        "'{\"type\":\"ROBOT\",\"heard\":1}', Robot, Robot, ROBOT",
        "'{\"type\":\"Robot\"}', ROBOT, Robot, ROBOT",
        "'{\"type\":\"Camera\",\"heard\":1}', ROBOT, Robot, ROBOT",
        "'{}', ROBOT, Robot, ROBOT",
        "'{}', '', Robot, Robot",
        "'{}', ROBOT, Thermometer, Thermometer"
    })
    void spellsATypeAsTheDeviceDid(String health, String requested, String desired, String spelled) {
        view.clear();
        view.put(Topics.DEVICES_HEALTH, KEY, health.getBytes(UTF_8));
        view.complete();

        assertThat(new DeviceView(view).spelledType(KEY, requested, desired)).isEqualTo(spelled);
    }
}
