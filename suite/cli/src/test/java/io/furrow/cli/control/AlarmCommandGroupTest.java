package io.furrow.cli.control;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class AlarmCommandGroupTest {
    @AutoClose
    private final StubControl control = new StubControl();

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            ''                                        | limit=51&state=open
            --state=all                               | limit=51
            --kind=fault --limit=1                    | limit=2&state=open&kind=fault
            --from=2026-05-01T06:00:00Z               | limit=51&from=2026-05-01T06%3A00%3A00Z
            --since=1777600000000 --state=closed      | limit=51&state=closed&from=2026-05-01T01%3A46%3A40Z
            --to=2026-05-02                           | limit=51&to=2026-05-02T00%3A00%3A00Z
            """)
    void asksForAlarmsOfATime(String options, String query) {
        control.run(("alarm list " + options).strip().split(" "));

        assertThat(control.requested()).containsExactly("GET /api/alarms?" + query);
    }

    @Test
    void mutesAlarmsOrAKindOfThem() {
        control.run("alarm", "mute", "a-1", "a-2", "--for", "8h");
        control.run("alarm", "mute", "--kind", "silent-device", "--subject", "urn:a");
        control.run("alarm", "unmute", "--kind", "fault");

        assertThat(control.requested())
                .containsExactly(
                        "POST /api/alarms/a-1/mute {\"for\":\"PT8H\"}",
                        "POST /api/alarms/a-2/mute {\"for\":\"PT8H\"}",
                        "POST /api/alarms/mute {\"kind\":\"silent-device\",\"subject\":\"urn:a\",\"for\":\"PT1H\"}",
                        "POST /api/alarms/unmute {\"kind\":\"fault\"}");
        for (String wrong : new String[] {"mute", "mute a --kind=fault", "unmute a --subject=s", "mute --subject=s"}) {
            assertThat(control.run(("alarm " + wrong).split(" "))).as(wrong).isEqualTo(2);
        }
        assertThat(control.output()).contains("Name alarms, or a kind with --kind, and its --subject.");
    }

    @Test
    void showsAnAlarm() {
        control.answer("GET /api/alarms/silent-device-1", """
                {'alarm':'silent-device-1','kind':'silent-device','subject':'urn:m','severity':'minor','state':'closed','change':'closed',
                 'text':'2 devices are silent','devices':[{'id':'urn:a'},{'id':'urn:b'}],'raised':1795687200000,'changed':1795687260000,
                 'count':7,'mutedUntil':1795701600000,'acknowledgedBy':'ann','reason':'they report again','sequence':9,'group':'urn:d'}""");

        assertThat(control.run("alarm", "show", "silent-device-1")).isZero();

        assertThat(control.output().lines().map(line -> line.replaceAll(" [(][^)]*[)]$", "")))
                .containsExactly(
                        "Alarm:          silent-device-1, minor",
                        "Text:           2 devices are silent",
                        "State:          closed: they report again",
                        "About:          silent-device of urn:m",
                        "Group:          urn:d",
                        "Devices:        urn:a, urn:b",
                        "Raised:         2026-11-26T10:00:00Z",
                        "Changed:        2026-11-26T10:01:00Z",
                        "Times seen:     7",
                        "Muted until:    2026-11-26T14:00:00Z",
                        "Acknowledged:   by ann");
    }
}
