package io.furrow.suite.page;

import java.io.IOException;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

/** The tables of devices, fields, replays and the map as CSV; those of results and missions: {@link ReportIT}. */
@Tag("full")
class CsvIT extends StubbedPage {
    private static final long START = 1_767_236_670_000L;
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";

    @BeforeEach
    void start() {
        String mission = """
                {"mission": "weeding", "domain": "farm", "template": "two@1", "running": true, "start": %1$d, "created": %1$d, "sequence": 2, "deviceCount": 1,
                 "status": {"mission": "weeding", "domain": "farm", "state": "running", "since": %1$d, "sequence": 2, "devices": 1, "confirmed": 1, "missing": []}}""".formatted(START);
        farm.hasField("barn", "farm", -3.482, 40.312)
                .hasRobot(1)
                .answers("/api/missions", "[" + mission + "]")
                .answers("/api/missions/weeding", mission)
                .answers("/api/devices", """
                        [{"id": "%s", "type": "ROBOT", "domain": "farm", "mission": "weeding", "from": 0, "sequence": 1, "status": {"state": "running"},
                          "health": {"battery": 0.81, "silent": true, "lastSeen": 1767236670000}}]""".formatted(ROBOT));
    }

    @Test
    void savesTheDevicesOfAMission() throws IOException {
        FarmPage page = farm.open("#/missions?mission=weeding", 1440, 900);
        assertThat(page.find(".device-table tbody tr")).hasCount(1);

        assertThat(ReportIT.csv(page, "Devices", "weeding-devices.csv"))
                .startsWith("Device,Id,Type,State,Health,Battery (%),Heard\r\n")
                .contains("\r\nRobot 1," + ROBOT + ",ROBOT,running,silent,81,");
    }

    @Test
    void savesFields() throws IOException {
        FarmPage page = farm.open("#/missions?tab=domains", 1440, 900);
        assertThat(page.find(".field-table tbody tr")).hasCount(1);

        assertThat(ReportIT.csv(page, "Fields", "fields.csv"))
                .isEqualTo("Field,Id,Domain,Kind,Crop,Since\r\nbarn,barn,farm,field,,2020-01-01T00:00:00.000Z\r\n");
    }

    @Test
    void savesRunningReplays() throws IOException {
        farm.hasReplay("weeding", "", "paused", START, START + 60_000, START + 50_000);
        FarmPage page = farm.open("#/replays", 1440, 900);
        assertThat(page.find(".running")).hasCount(1);

        assertThat(ReportIT.csv(page, "Running", "replays.csv"))
                .isEqualTo(
                        "Mission,State,From,To,At,Speed\r\n"
                                + "weeding,paused,2026-01-01T03:04:30.000Z,2026-01-01T03:05:30.000Z,2026-01-01T03:05:20.000Z,1\r\n");
    }

    @Test
    void savesTheTablesOfTheMap() throws IOException {
        long now = System.currentTimeMillis();
        farm.answers("/api/history/data.coverage", CoverageIT.records(CoverageIT.figures("weeding", "", now, 0.31)));
        FarmPage page = farm.open("#/map?table=1", 1440, 900);
        assertThat(page.find("table[aria-label='Worked area'] tbody tr")).hasCount(1);

        assertThat(ReportIT.csv(page, "Devices", "map-devices.csv"))
                .startsWith("Name,Id,Kind,State,Latitude,Longitude,Speed (m/s),Heard\r\n")
                .contains("," + ROBOT + ",robot,", ",40.3126,-3.4822,1.5,");
        assertThat(ReportIT.csv(page, "Fields", "map-fields.csv")).contains("\r\nbarn,,,,\r\n");
        assertThat(ReportIT.csv(page, "Worked area", "map-coverages.csv"))
                .contains("\r\nbarn,weeding,0.31,62,0.06,0.02,1800,");
        page.button("Save as CSV: Worked area").focus();
        farm.send("data.raw", ROBOT, StubFarm.robot(1, "Running", "farm", "weeding", 40.3129, -3.4822));
        assertThat(page.find(".map-tables")).containsText("40.31290");
        assertThat(page.button("Save as CSV: Worked area")).isFocused();
    }
}
