package io.furrow.cli.control.table;

import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class DevicePageTest {
    private static final Instant NOW = Instant.parse("2026-11-26T12:00:00Z");

    @Test
    void reportsFirstWhyADeviceIsSilentAndThenWhatIsKnownOfIt() throws Exception {
        assertThat(page("""
                        {"id": "urn:t:1", "type": "Thermometer", "mission": "m", "domain": "d", "wanted": "running", "from": 5,
                         "status": {"sequence": 3, "state": "running"}, "health": {"heard": 1795687200000, "silent": true, "battery": 0.815},
                         "connection": {"since": 1795680000000, "loggedIn": 1795687200000, "registered": true, "cause": "why",
                          "refusedLogin": {"count": 1, "last": 1795694395000, "reason": "wrong-password", "user": "u"},
                          "unreadablePayload": {"count": 2, "last": 1795694340000, "reason": "not JSON: more follows", "payload": "{}{\\u001b"},
                          "foreignTopic": {"count": 1, "last": 1795690800000, "topic": "/k/e/attrs"},
                          "lastReport": {"time": 1795680000000, "received": 1795687200000, "offset": 7200000}}}"""))
                .containsExactly(
                        "Silent:         why",
                        "Device:         urn:t:1",
                        "Type:           Thermometer, real",
                        "Mission:        m of domain d",
                        "Wanted:         running",
                        "State:          running",
                        "Last report:    of 2026-11-26T08:00:00Z, received 2026-11-26T10:00:00Z (2h ago)",
                        "Clock:          its clock is 2 h 0 min behind",
                        "Battery:        82 %",
                        "Last login:     2026-11-26T10:00:00Z (2h ago)",
                        "Refused logins: once, 2026-11-26T11:59:55Z (5s ago): wrong password of user u",
                        "Unreadable:     2 times, last 2026-11-26T11:59:00Z (60s ago): not JSON: more follows; it began with {}{ ",
                        "Foreign topic:  published once, 2026-11-26T11:00:00Z (60m ago) to /k/e/attrs, where it may not",
                        "IoT Agent:      knows it");
    }

    @Test
    void reportsThatADeviceHasNotReportedYet() throws Exception {
        assertThat(page("{'id':'urn:t:1','simulated':true,'wanted':'running','from':5}".replace('\'', '"')))
                .startsWith("Silent:         it has not reported yet")
                .contains("Type:           not known, simulated", "Last report:    none yet");
    }

    @Test
    void reportsNothingOfSilenceWhereADeviceReportsIsOffOrShallNotRun() throws Exception {
        for (String device : List.of(
                "{'wanted':'running','from':5,'health':{'heard':5,'silent':false}}",
                "{'wanted':'running','from':5,'health':{'heard':5,'silent':true,'off':true}}",
                "{'wanted':'stopped','from':5}")) {
            assertThat(page(device.replace('\'', '"')).get(0)).startsWith("Device:");
        }
    }

    @Test
    void reportsWhatAClockIsAhead() throws Exception {
        assertThat(page("{\"connection\":{\"lastReport\":{\"time\":1,\"received\":1,\"offset\":-63000}}}"))
                .contains("Clock:          its clock is 1 min 3 s ahead");
    }

    private static List<String> page(String json) throws Exception {
        return DevicePage.of(NgsiJson.mapper().readTree(json), NOW);
    }
}
