package io.furrow.model.device;

import java.io.IOException;
import java.io.InputStream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DeviceVersionTest {
    private static final DeviceVersion ROBOT = new DeviceVersion(
            "urn:ngsi-ld:AgriRobot:1",
            "farm",
            "/north",
            "north",
            "weeding",
            1_700_000_000_000L,
            1_700_000_600_000L,
            7,
            "urn:ngsi-ld:Tractor:2");
    private static final DeviceVersion THERMOMETER =
            new DeviceVersion("urn:ngsi-ld:Thermometer:1", "", "/", "north", "", 0, null, 0, null, true);

    @Test
    void isWrittenAndReadAsItsGoldenJson() throws Exception {
        assertThat(new String(ROBOT.toBytes(), UTF_8)).isEqualTo(golden("robot"));
        assertThat(new String(THERMOMETER.toBytes(), UTF_8)).isEqualTo(golden("thermometer"));
        assertThat(read(golden("robot"))).isEqualTo(ROBOT);
        assertThat(read(golden("thermometer"))).isEqualTo(THERMOMETER);
    }

    @Test
    void requiresOnlyAnIdATimeAndASequence() throws Exception {
        assertThat(read("{'id':'r','from':5,'sequence':1,'mission':null,'until':null,'colour':{'of':'later'}}"))
                .isEqualTo(new DeviceVersion("r", "", "/", "", "", 5, null, 1, null));
    }

    @Test
    void distinguishesDevicesOfOneIdInTwoTenants() throws Exception {
        assertThat(read("{'id':'r','service':'A','from':5,'sequence':1}").key()).isEqualTo("a|/|r");
        assertThat(read("{'id':'r','service':'b','from':5,'sequence':1}").key()).isEqualTo("b|/|r");
    }

    @Test
    void isValidFromItsTimeUntilItsEnd() {
        assertThat(ROBOT.holdsAt(ROBOT.from() - 1)).isFalse();
        assertThat(ROBOT.holdsAt(ROBOT.from())).isTrue();
        assertThat(ROBOT.holdsAt(ROBOT.until() - 1)).isTrue();
        assertThat(ROBOT.holdsAt(ROBOT.until())).isFalse();
        assertThat(THERMOMETER.holdsAt(Long.MAX_VALUE)).isTrue();
        assertThat(THERMOMETER.endingAt(9).holdsAt(9)).isFalse();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
                    {"id"                                     | NOT_JSON
                    7                                         | NOT_AN_EVENT
                    {'from':1,'sequence':1}                   | NOT_AN_EVENT
                    {'id':' ','from':1,'sequence':1}          | NOT_AN_EVENT
                    {'id':7,'from':1,'sequence':1}            | NOT_AN_EVENT
                    {'id':'r','sequence':1}                   | NOT_AN_EVENT
                    {'id':'r','from':1}                       | NOT_AN_EVENT
                    {'id':'r','from':-1,'sequence':1}         | NOT_AN_EVENT
                    {'id':'r','from':1.5,'sequence':1}        | NOT_AN_EVENT
                    {'id':'r','from':'1','sequence':1}        | NOT_AN_EVENT
                    {'id':'r','from':5,'sequence':1,'until':4} | NOT_AN_EVENT
                    {'id':'r','from':5,'sequence':1,'domain':4} | NOT_AN_EVENT
                    """)
    void rejectsInvalidDevices(String json, Reason reason) {
        assertThatThrownBy(() -> read(json))
                .isInstanceOfSatisfying(
                        UnreadableException.class, e -> assertThat(e.reason()).isEqualTo(reason));
    }

    private static DeviceVersion read(String json) throws UnreadableException {
        return DeviceVersion.read(json.replace('\'', '"').getBytes(UTF_8));
    }

    private static String golden(String name) throws IOException {
        try (InputStream json = DeviceVersionTest.class.getResourceAsStream("/golden/device/" + name + ".json")) {
            return new String(json.readAllBytes(), UTF_8).strip();
        }
    }
}
