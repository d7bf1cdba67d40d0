package io.furrow.control.mission;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class CredentialsTest {
    private static final String DEVICE = "urn:ngsi-ld:Thermometer:m-1";

    private final FarmFixture farm = new FarmFixture();

    @BeforeEach
    void startAMission() throws Exception {
        farm.domain("north");
        start();
        farm.hostAll();
    }

    @Test
    void requestsTheNextGenerationOfOneDevice() throws Exception {
        DesiredDevice before = farm.device(DEVICE);
        DesiredDevice other = farm.device("urn:ngsi-ld:Thermometer:m-2");

        assertThat(rotate(DEVICE))
                .isEqualTo("{\"type\":\"response\",\"status\":\"rotated\",\"device\":\"%s\",\"generation\":1}"
                        .formatted(DEVICE));

        var requested =
                DesiredDevice.read(farm.publisher.compacted(Topics.DEVICES).get("farm|/|" + DEVICE));
        assertThat(requested.generation()).isEqualTo(1);
        assertThat(requested.version().sequence())
                .isGreaterThan(before.version().sequence());
        assertThat(requested.version().from()).isEqualTo(before.version().from());
        assertThat(requested.settings()).isEqualTo(before.settings());
        assertThat(farm.device("urn:ngsi-ld:Thermometer:m-2")).isEqualTo(other);
        assertThat(rotate(DEVICE)).contains("\"generation\":2");
    }

    @Test
    void countsARestartedDeviceOnce() throws Exception {
        rotate(DEVICE);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        assertThat(farm.status("m").confirmed()).isEqualTo(2);

        farm.report(farm.device(DEVICE), State.FAILED);
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
        farm.report(farm.device(DEVICE), State.RUNNING);
        farm.report(farm.device(DEVICE), State.RUNNING);

        assertThat(farm.status("m").confirmed()).isEqualTo(2);
    }

    @Test
    void neverAcceptsARevokedPasswordAgain() throws Exception {
        rotate(DEVICE);
        stop();
        start();
        assertThat(farm.device(DEVICE).generation()).isEqualTo(1);

        stop();
        farm.request(new MissionCommand.Delete("m"));
        assertThat(farm.publisher.compacted(Topics.DEVICES)).isEmpty();
        rejects(DEVICE, ErrorCode.UNKNOWN_DEVICE);

        start();
        assertThat(farm.device(DEVICE).generation()).isEqualTo(1);
        assertThat(farm.device("urn:ngsi-ld:Thermometer:m-2").generation()).isZero();
    }

    @Test
    void readsStateWithoutGenerations() {
        DeviceState state = StateJson.read(
                "{\"wanted\":{\"mission\":\"m\"},\"confirmed\":true}".getBytes(UTF_8), DeviceState.class);

        assertThat(state.forgotten()).isFalse();
        assertThat(state.generation()).isZero();
        assertThat(StateJson.read(StateJson.write(state.asForgotten()), DeviceState.class))
                .isEqualTo(state.asForgotten());
    }

    @Test
    void rejectsUnknownDevicesAndThoseWithTheirOwnLogin() throws Exception {
        farm.start("other", "north", DeviceGroup.entity("urn:robot"));

        rejects("urn:nosuch", ErrorCode.UNKNOWN_DEVICE);
        rejects("urn:robot", ErrorCode.NO_CREDENTIALS);
    }

    private void start() throws RejectedException {
        farm.start("m", "north", FarmFixture.group("Thermometer", 2));
    }

    private void stop() throws RejectedException {
        farm.request(new MissionCommand.Stop("m"));
        farm.hostAll();
    }

    private String rotate(String device) throws RejectedException {
        return farm.request(new MissionCommand.RotateCredentials(device)).json().toString();
    }

    private void rejects(String device, ErrorCode code) {
        String before = farm.content();
        assertThatThrownBy(() -> rotate(device))
                .isInstanceOfSatisfying(
                        RejectedException.class,
                        rejection -> assertThat(rejection.code()).isEqualTo(code))
                .hasMessageContaining("'" + device + "'");
        assertThat(farm.content()).isEqualTo(before);
    }
}
