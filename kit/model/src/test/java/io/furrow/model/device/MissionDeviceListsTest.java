package io.furrow.model.device;

import java.util.Optional;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionDeviceListsTest {
    private static final ObjectNode NONE = JsonNodeFactory.instance.objectNode();

    private final MissionDeviceLists lists = new MissionDeviceLists();

    @Test
    void resolvesTheSettingsOfTheGroup() throws Exception {
        take(0, 7, "['urn:own',{'type':'Camera','count':2,'area':'field-1','period':'PT5S','speed':null}]");
        take(1, 8, "[{'type':'Robot','path':[[1,2]]}]");

        assertThat(settings(new GroupRef(0, 1, 0, 7))).contains("{\"area\":\"field-1\"}");
        assertThat(settings(new GroupRef(1, 0, 0, 8))).contains("{\"path\":[[1,2]]}");
        assertThat(settings(new GroupRef(0, 0, 0, 7))).contains("{}");
        assertThat(settings(new GroupRef(0, 9, 0, 7))).contains("{}");
    }

    /** The record of the device may arrive before that of the part, and may be older. */
    @Test
    void resolvesNothingFromAPartOfAnotherSequence() throws Exception {
        assertThat(settings(new GroupRef(0, 0, 0, 7))).isEmpty();
        take(0, 7, "[{'type':'Camera','area':'a'}]");
        assertThat(settings(new GroupRef(0, 0, 0, 7))).isPresent();
        take(0, 9, "[{'type':'Camera','area':'b'}]");
        assertThat(settings(new GroupRef(0, 0, 0, 7))).isEmpty();
        assertThat(settings(new GroupRef(0, 0, 0, 9))).contains("{\"area\":\"b\"}");
        lists.take("m.0", null);
        assertThat(settings(new GroupRef(0, 0, 0, 9))).isEmpty();
    }

    @Test
    void keepsTheSettingsOfADeviceThatContainsThem() throws Exception {
        DesiredDevice device = device(null);
        assertThat(lists.resolve(device)).containsSame(device);
    }

    @Test
    void readsBackAPart() throws Exception {
        ArrayNode devices = (ArrayNode) json("['urn:own']");
        MissionDeviceList list = new MissionDeviceList("m", 3, 9, devices);
        assertThat(list.key()).isEqualTo("m.3");
        assertThat(MissionDeviceList.read(list.toBytes())).isEqualTo(list);
        DesiredDevice device = device(new GroupRef(3, 0, 0, 9));
        assertThat(DesiredDevice.read(device.toBytes())).isEqualTo(device);
        assertThat(new String(device.toBytes(), UTF_8))
                .endsWith("\"group\":{\"part\":3,\"index\":0,\"member\":0,\"sequence\":9}}");
        for (String wrong : new String[] {"{}", "[]", "{'mission':'m','part':0,'sequence':1,'devices':{}}"}) {
            assertThatThrownBy(() -> MissionDeviceList.read(bytes(wrong))).isInstanceOf(UnreadableException.class);
        }
        lists.take("m.0", bytes("{}"));
        assertThatThrownBy(() -> lists.resolve(device(new GroupRef(0, 0, 0, 1))))
                .isInstanceOf(UnreadableException.class);
    }

    private Optional<String> settings(GroupRef group) throws Exception {
        return lists.resolve(device(group)).map(device -> device.settings().toString());
    }

    private void take(int part, long sequence, String devices) throws Exception {
        MissionDeviceList list = new MissionDeviceList("m", part, sequence, (ArrayNode) json(devices));
        lists.take(list.key(), list.toBytes());
    }

    private static DesiredDevice device(GroupRef group) {
        DeviceVersion version = new DeviceVersion("urn:x", "farm", "/", "d", "m", 5, null, 7, null);
        return new DesiredDevice(version, "Camera", "x", true, null, true, NONE, group, 0);
    }

    private static com.fasterxml.jackson.databind.JsonNode json(String text) throws Exception {
        return NgsiJson.read(bytes(text));
    }

    private static byte[] bytes(String json) {
        return json.replace('\'', '"').getBytes(UTF_8);
    }
}
