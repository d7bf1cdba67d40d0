package io.furrow.cli.control.table;

import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class MissionPageTest {
    private static final Instant NOW = Instant.parse("2026-11-26T12:00:00Z");

    @Test
    void reportsHowAMissionIsAndWhichDevicesItMisses() throws Exception {
        assertThat(MissionPage.of(NgsiJson.mapper().readTree("""
                        {"mission": "m", "domain": "d", "template": "t@2", "running": true, "start": 1795687200000, "created": 1795680000000,
                         "sequence": 3, "devices": ["urn:own:1", {"type": "Robot", "id": "urn:r:1", "carriedBy": "g"},
                          {"type": "Thermometer", "count": 3, "period": "PT10S", "simulated": true}],
                         "status": {"mission": "m", "domain": "d", "state": "starting", "since": 1795687200000, "sequence": 3, "devices": 5,
                          "confirmed": 3, "reason": "2 devices are not up", "ends": 1795701600000,
                          "missing": [{"id": "urn:r:1", "reason": "it never logged in"}, {"id": "urn:t:2\\u009b"}]}}"""), NOW))
                .containsExactly(
                        "Mission:        m of domain d",
                        "Template:       t@2",
                        "State:          starting since 2026-11-26T10:00:00Z (2h ago): 2 devices are not up",
                        "Devices:        3 of 5 are up",
                        "Missing:        urn:r:1: it never logged in",
                        "Missing:        urn:t:2 ",
                        "Start:          2026-11-26T10:00:00Z (2h ago)",
                        "End:            2026-11-26T14:00:00Z (in 2h)",
                        "Group:          urn:own:1, which has a login of its own",
                        "Group:          urn:r:1 of type Robot, real, carriedBy g",
                        "Group:          3 devices of type Thermometer, simulated, period PT10S",
                        "Created:        2026-11-26T08:00:00Z (4h ago)");
    }

    /** After a stop they are counted that have stopped. */
    @ParameterizedTest
    @CsvSource(nullValues = "-", textBlock = """
            created,  -
            running,  Devices:        3 of 5 are up
            stopping, Devices:        3 of 5 are stopped
            stopped,  -
            failed,   -
            """)
    void countsDevicesOnlyWhileTheyStartRunOrStop(String state, String line) throws Exception {
        String mission =
                "{\"mission\":\"m\",\"domain\":\"d\",\"status\":{\"state\":\"%s\",\"devices\":5,\"confirmed\":3}}";

        assertThat(MissionPage.of(NgsiJson.mapper().readTree(mission.formatted(state)), NOW))
                .filteredOn(each -> each.startsWith("Devices"))
                .isEqualTo(line == null ? List.of() : List.of(line));
    }
}
