package io.furrow.model.device;

import java.time.Duration;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DesiredDeviceTest {
    private static final DeviceVersion VERSION =
            new DeviceVersion("urn:Camera:m-1", "farm", "/", "d", "m", 5, 9L, 7, "urn:Robot:m-1");

    @Test
    void isReadByJobsAsItsVersion() throws Exception {
        DesiredDevice camera = DesiredDevice.simulated(
                VERSION,
                "Camera",
                "camera-m-1",
                false,
                Duration.ofSeconds(5),
                JsonNodeFactory.instance.objectNode().put("area", "field-1"));

        assertThat(DeviceVersion.read(camera.toBytes())).isEqualTo(VERSION);
        assertThat(DesiredDevice.read(camera.toBytes())).isEqualTo(camera);
        assertThat(new String(camera.toBytes(), UTF_8)).isEqualTo("""
                {"id":"urn:Camera:m-1","service":"farm","servicePath":"/","domain":"d","mission":"m","from":5,"until":9,\
                "sequence":7,"carriedBy":"urn:Robot:m-1","type":"Camera","device":"camera-m-1","simulated":true,"wanted":"stopped",\
                "period":"PT5S","settings":{"area":"field-1"}}""");
    }

    @Test
    void readsRecordsWithAndWithoutAGeneration() throws Exception {
        DesiredDevice rotated = DesiredDevice.read(VERSION.toBytes()).withGeneration(3);

        assertThat(DesiredDevice.read(rotated.toBytes())).isEqualTo(rotated);
        assertThat(new String(rotated.toBytes(), UTF_8)).endsWith(",\"generation\":3}");
        assertThat(DesiredDevice.read(VERSION.toBytes()).generation()).isZero();
        assertThatThrownBy(
                        () -> DesiredDevice.read(bytes("{\"id\":\"a\",\"from\":0,\"sequence\":1,\"generation\":-1}")))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("'generation'");
    }

    @Test
    void isRealUnlessItIsMarkedAsSimulated() throws Exception {
        DesiredDevice robot = DesiredDevice.read(VERSION.toBytes());

        assertThat(robot.simulated()).isFalse();
        assertThat(robot.running()).isTrue();
        assertThat(DesiredDevice.read(robot.toBytes())).isEqualTo(robot);
    }

    @Test
    void rejectsInvalidStatuses() throws Exception {
        DeviceStatus failed = new DeviceStatus(7, DeviceStatus.State.FAILED, "no route to the MQTT broker");

        assertThat(DeviceStatus.read(failed.toBytes())).isEqualTo(failed);
        assertThat(DeviceStatus.read(bytes("{\"sequence\":1,\"state\":\"running\",\"battery\":0.5}")))
                .isEqualTo(new DeviceStatus(1, DeviceStatus.State.RUNNING, null));
        assertThatThrownBy(() -> DeviceStatus.read(bytes("{\"sequence\":1,\"state\":\"odd\"}")))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("running, stopped or failed");
        assertThatThrownBy(() -> DeviceStatus.read(bytes("{\"sequence\":1.5,\"state\":\"running\"}")))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("sequence");
    }

    private static byte[] bytes(String json) {
        return json.getBytes(UTF_8);
    }
}
