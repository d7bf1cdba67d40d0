package io.furrow.suite.page;

import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** Findings about devices before a mission starts, from the state of the farm. */
@PageTest
@Tag("full")
class DeviceCheckIT {
    private static final String FARM_STATE = """
            { now: 1000000000, mission: 'new',
              fields: new Map([['f', { id: 'f', name: 'Upper field', exclusion: false, properties: {}, geometry: { type: 'Polygon',
                coordinates: [[[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]], [[0.5, 0.5], [1, 0.5], [1, 1], [0.5, 1], [0.5, 0.5]]] } }]]),
              missions: new Map([['other', { running: true }], ['over', { running: false }]]),
              devices: new Map([
                ['fit', { wanted: 'running', health: { lastSeen: 999999000, battery: 0.9 } }],
                ['silent', { wanted: 'running', health: { lastSeen: 999000000, silent: true, battery: 0.9 } }],
                ['low', { wanted: 'running', health: { lastSeen: 999999000, battery: 0.19 } }],
                ['used', { wanted: 'running', mission: 'other', health: { lastSeen: 999999000, battery: 0.9 } }],
                ['free', { wanted: 'running', mission: 'over', health: { lastSeen: 999999000, battery: 0.9 } }],
                ['off', { wanted: 'stopped', health: { lastSeen: 1, battery: 0.9 } }]]),
              entityOf: ({ id }) => new Map(Object.entries({ fit: [1.5, 1.5], silent: [1.5, 1.5], low: [1.5, 1.5], used: [1.5, 1.5], free: [1.5, 1.5], off: [1.5, 1.5], hole: [0.7, 0.7], far: [9, 9] })
                .map(([id, position]) => [id, { position, heard: ['silent', 'off'].includes(id) ? 1 : 999999000, attributes: { battery: { value: 90 } } }])).get(id) }""";

    @Test
    void findsWhatIsWrongWithEachDevice(FarmPage farm) {
        assertThat(check(farm, "['fit', 'silent', 'low', 'used', 'free', 'hole', 'far', 'never-heard-of']"))
                .containsExactly(
                        "fit ok [seen, battery, inside]",
                        "silent warning [silent, battery, inside]",
                        "low warning [seen, batteryLow, inside]",
                        "used problem [used, seen, battery, inside]",
                        "free ok [seen, battery, inside]",
                        "hole warning [seen, battery, outside]",
                        "far warning [seen, battery, outside]",
                        "never-heard-of warning [neverSeen, noBattery, noPosition]");
    }

    @Test
    void acceptsDevicesThatAreSwitchedOffOrCreatedByTheMission(FarmPage farm) {
        assertThat(check(farm, """
                [{ id: 'off', type: 'T' }, { type: 'Thermometer', count: 3, path: [[1.5, 1.5]] }, { type: 'Robot', count: 1, path: [[5, 5]] }, \
                { type: 'Camera', count: 1, area: 'f' }, { type: 'Camera', count: 1, area: 'gone' }]"""))
                .containsExactly(
                        "off ok [off, battery, inside]",
                        "Thermometer ok [made, inside]",
                        "Robot warning [made, outside]",
                        "Camera ok [made, inside]",
                        "Camera warning [made, noSuchField]");
    }

    @SuppressWarnings("unchecked")
    private static List<String> check(FarmPage farm, String groups) {
        List<Map<String, Object>> checked = (List<Map<String, Object>>)
                farm.run(
                        "async () => { const { checkPlan } = await import('/views/missions/check.js'); return checkPlan("
                                + groups + ", 'farm', " + FARM_STATE
                                + ").map((each) => ({ text: `${each.name} ${each.worst} [${each.findings.map((finding) => finding.text).join(', ')}]` })); }");
        return checked.stream().map(each -> (String) each.get("text")).toList();
    }
}
