package io.furrow.cli.control;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class StatusCommandTest {
    private static final String READY = "{'status':'ready','parts':{'view':{'state':'up'},'kafka':{'state':'up'}}}";
    private static final String NOT_READY = """
            {'status':'not-ready','warnings':['the clock was set back'],'parts':{'view':{'state':'up'},
             'managers':{'state':'down','lastSuccess':'2026-11-26T10:00:00Z','detail':'REBALANCING'}}}""";
    private static final String MISSIONS =
            "[{'mission':'a','status':{'state':'running'}},{'mission':'b','status':{'state':'created'}},{'mission':'c','status':{'state':'running'}}]";
    private static final String ALARMS = "[{'severity':'critical'},{'severity':'minor'},{'severity':'minor'}]";
    private static final String TOPICS =
            "[{'topic':'data.raw','records':5},{'topic':'data.raw.dead','records':7},{'topic':'x.dead','records':0}]";

    @AutoClose
    private final StubControl control = new StubControl();

    @Test
    void showsThatAllIsWell() {
        control.answer("GET /ready", READY)
                .answer("GET /api/missions", "[]")
                .answer("GET /api/alarms?state=open", "[]")
                .answer("GET /api/v1/topics", "[]");

        assertThat(control.run("status")).isZero();

        assertThat(control.output().lines())
                .containsExactly(
                        "Status:         ready",
                        "Parts:          2 parts up",
                        "Missions:       none",
                        "Open alarms:    none",
                        "Dead letters:   none",
                        "Lag:            the dashboard knows it, for instance --api http://127.0.0.1:8080");
    }

    /** Not ready is an answer here, which is not waited for. */
    @Test
    void showsWhatDoesNotWorkBeforeWhatThereIs() {
        control.answer("GET /ready", 503, NOT_READY)
                .answer("GET /api/missions", 503, "{'error':'not-ready','reason':'the topics are read'}")
                .answer("GET /api/alarms?state=open", ALARMS)
                .answer("GET /api/v1/topics", TOPICS);

        assertThat(control.run("status")).isEqualTo(1);

        assertThat(control.output().lines())
                .containsExactly(
                        "Status:         not-ready",
                        "Not up:         managers, down, last up at 2026-11-26T10:00:00Z: REBALANCING",
                        "Warning:        the clock was set back",
                        "Parts:          1 part up",
                        "Missions:       not known: the topics are read (not-ready)",
                        "Open alarms:    1 critical, 2 minor",
                        "Dead letters:   data.raw.dead 7",
                        "Lag:            the dashboard knows it, for instance --api http://127.0.0.1:8080");
        assertThat(control.requested()).hasSize(5);
    }

    @Test
    void showsTheLagThatTheDashboardKnows() throws Exception {
        control.answer("GET /api/platform", """
                        {'controlPlane':{'status':'degraded','parts':{}},'kafka':{'state':'up'},
                         'groups':[{'group':'ingest','lag':12},{'group':'averages','lag':0}]}""").answer("GET /api/missions", MISSIONS);

        assertThat(control.run("status")).isEqualTo(1);
        assertThat(control.output())
                .startsWith("Status:         degraded")
                .contains("Missions:       2 running, 1 created", "Lag:            ingest 12, averages 0");

        control.run("status", "-o", "json");
        assertThat(NgsiJson.mapper()
                        .readTree(control.output())
                        .at("/lag/ingest")
                        .asInt())
                .isEqualTo(12);
    }
}
