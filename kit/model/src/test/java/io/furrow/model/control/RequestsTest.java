package io.furrow.model.control;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class RequestsTest {
    /** As the WeLASER dashboard sends it. */
    @Test
    void takesARequestWithoutCommandForANewDomain() {
        assertThat(Requests.domain(json("{'type':'request','domain':'canary'}")))
                .isEqualTo(new ParsedRequest.Request<>(null, new DomainCommand.Create("canary", DomainDetails.NONE)));
    }

    @Test
    void takesTheOriginalRequestsForMissionsAndReplays() {
        assertThat(Requests.mission(json("{'type':'request','command':'start','mission':'m','domain':'d'}")))
                .isEqualTo(new ParsedRequest.Request<>(
                        null, new MissionCommand.Start("m", "d", new MissionPlan.Unspecified(), null, null)));
        assertThat(Requests.mission(json("{'type':'request','command':'stop','mission':'m','sent':{'by':'them'}}")))
                .isEqualTo(new ParsedRequest.Request<>(null, new MissionCommand.Stop("m")));
        assertThat(Requests.replay(json("{'type':'request','command':'start','mission':'m'}")))
                .isEqualTo(new ParsedRequest.Request<>(
                        null, new ReplayCommand.Start(List.of("m"), null, 1, null, ReplayPlan.PLAIN)));
        assertThat(Requests.replay(json("{'type':'request','command':'stop','replay':'m.0a1b2c3d'}")))
                .isEqualTo(new ParsedRequest.Request<>(
                        null,
                        new ReplayCommand.Simple(ReplayCommand.Target.of("m.0a1b2c3d"), ReplayCommand.Verb.STOP)));
    }

    @Test
    void readsEveryMemberOfAStart() {
        ParsedRequest<MissionCommand> parsedRequest = Requests.mission(json("""
                {'type':'request','requestId':'r-1','command':'start','mission':'m','domain':'d','start':'2026-03-01T08:00:00+01:00',
                 'duration':'PT2H','devices':['urn:robot:1',{'name':'tractor','type':'Robot','count':2,'simulated':true,'period':'PT0.5S','speed':1.5,
                 'path':[[-3.48,40.31],[-3.47,40.31]]},{'type':'Camera','count':4,'carriedBy':'tractor','area':'field-1',
                 'faults':[{'kind':'silent','from':5}],'parameters':{'width':64}}]}"""));

        assertThat(parsedRequest).isInstanceOfSatisfying(ParsedRequest.Request.class, request -> {
            assertThat(request.requestId()).isEqualTo("r-1");
            MissionCommand.Start start = (MissionCommand.Start) request.command();
            assertThat(start.start()).isEqualTo(Instant.parse("2026-03-01T07:00:00Z"));
            assertThat(start.duration()).isEqualTo(Duration.ofHours(2));
            MissionDevices devices = ((MissionPlan.OfDevices) start.plan()).devices();
            assertThat(devices.count()).isEqualTo(7);
            assertThat(devices.groups())
                    .extracting(DeviceGroup::simulated, DeviceGroup::label, DeviceGroup::carriedBy)
                    .containsExactly(
                            org.assertj.core.groups.Tuple.tuple(null, "urn:robot:1", null),
                            org.assertj.core.groups.Tuple.tuple(true, "tractor", null),
                            org.assertj.core.groups.Tuple.tuple(null, null, "tractor"));
            assertThat(devices.groups().get(2).settings().path("parameters"))
                    .isEqualTo(JsonNodeFactory.instance.objectNode().put("width", 64));
        });
    }

    @Test
    void passesOverResponsesAndRecordsWithoutAValue() {
        assertThat(Requests.domain(null)).isEqualTo(new ParsedRequest.Passed<>());
        assertThat(Requests.domain(CommandResult.of("created").to("r").toBytes()))
                .isEqualTo(new ParsedRequest.Passed<>());
        assertThat(Requests.domain(json("{'type':'response'}"))).isEqualTo(new ParsedRequest.Passed<>());
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {'type':'request',                                               | not-json
            ''                                                               | not-a-request
            []                                                               | not-a-request
            {}                                                               | not-a-request
            {'type':'reqest','domain':'d'}                                   | not-a-request
            {'type':'request','type':'request','domain':'d'}                 | not-json
            {'type':'request'}                                               | missing-member
            {'type':'request','domain':null}                                 | missing-member
            {'type':'request','domain':7}                                    | wrong-member
            {'type':'request','domain':''}                                   | illegal-name
            {'type':'request','domain':'a.b'}                                | illegal-name
            {'type':'request','domain':'f\u00e9ld'}                          | illegal-name
            {'type':'request','domain':'d','command':'explode'}              | unknown-command
            {'type':'request','domain':'d','command':7}                      | wrong-member
            {'type':'request','domain':'d','requestId':''}                   | wrong-member
            {'type':'request','domain':'d','requestId':{}}                   | wrong-member
            {'type':'request','domain':'d','name':'\\ud800'}                 | not-json
            {'type':'request','domain':'d','area':'north'}                   | wrong-member
            {'type':'request','domain':'d','area':{'type':'Point'}}          | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':7}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[7]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[[{}]]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[[[]]]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[[[null,0],[1,0],[1,1],[null,0]]]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[[[0,0],[1],[1,1],[0,0]]]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon','coordinates':[[[0,0],[1e99,0],[1,1],[0,0]]]}} | wrong-member
            {'type':'request','domain':'d','area':{'type':'Polygon'}} | wrong-member
            {'type':'request','domain':'d','fields':['a b']}                 | wrong-member
            {'type':'request','domain':'d','command':'delete','force':'yes'} | wrong-member
            """)
    void answersWhatIsNoRequestToADomain(String request, String code) {
        assertThat(refusal(Requests.domain(json(request)))).isEqualTo(code);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {'type':'request','mission':'m','domain':'d'}                    | missing-member
            {'command':'start','mission':'m','duration':'2 hours'}           | wrong-member
            {'command':'start','mission':'m','duration':'PT-1S'}             | wrong-member
            {'command':'start','mission':'m','start':'tomorrow'}             | wrong-member
            {'command':'start','mission':'m','start':-1}                     | wrong-member
            {'command':'start','mission':'m','start':'+999999999-12-31T23:59:59Z'} | wrong-member
            {'command':'start','mission':'m','template':'a@0'}               | illegal-name
            {'command':'start','mission':'m','template':'a','devices':[]}    | wrong-member
            {'command':'start','mission':'m','devices':{}}                   | wrong-member
            {'command':'start','mission':'m','devices':[7]}                  | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','name':'x','id':'a'},{'type':'T','name':'y','id':'a'}]} | wrong-member
            {'command':'start','mission':'m','devices':['a b']}              | wrong-member
            {'command':'start','mission':'m','devices':['a','a']}            | wrong-member
            {'command':'start','mission':'m','devices':[{'count':1}]}        | missing-member
            {'command':'start','mission':'m','devices':[{'type':'T','count':0}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','count':1.5}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','count':9999},{'type':'T','count':2}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','id':'x','count':2}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','carriedBy':'x'}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','name':'x','carriedBy':'x'}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','period':5}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','faults':[{'kind':'tired'}]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','path':[[200,1]]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','speed':1e999}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','simulated':'yes'}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','at':[1,2]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','at':{'latitude':91,'longitude':0}}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','count':2,'at':[{'latitude':1,'longitude':1}]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','attributes':{}}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','attributes':[{'object_id':'t'}]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','attributes':[{'name':'a b'}]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','attributes':[{'name':'T','unit':'celsius'}]}]} | wrong-member
            {'command':'start','mission':'m','devices':[{'type':'T','attributes':['T']}]} | wrong-member
            {'command':'create','mission':'m','domain':'d','devices':[{'type':'T','area':{'type':'Polygon','coordinates':[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}}]} | wrong-member
            {'command':'start','mission':'m','devices':['a',{'type':'T','area':{'type':'Polygon','coordinates':[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}}]} | wrong-member
            {'command':'add-devices','mission':'m','devices':[{'type':'T','area':{'type':'Polygon','coordinates':[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}}]} | wrong-member
            {'command':'save-template','template':'t','devices':[{'type':'T','area':{'type':'Polygon','coordinates':[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}}]} | wrong-member
            {'command':'delete','mission':'m m'}                             | illegal-name
            """)
    void answersWhatIsNoRequestToAMission(String request, String code) {
        String whole = request.replace("{'command'", "{'type':'request','command'");
        assertThat(refusal(Requests.mission(json(whole)))).isEqualTo(code);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {'command':'start','mission':'m','speed':0.05}                   | wrong-member
            {'command':'start','mission':'m','speed':'fast'}                 | wrong-member
            {'command':'start','mission':'m','from':5,'to':5}                | wrong-member
            {'command':'start','mission':'m','loop':1}                       | wrong-member
            {'command':'stop','replay':'m'}                                  | illegal-name
            {'command':'stop'}                                               | missing-member
            {'command':'seek','replay':'m.0a1b2c3d'}                         | missing-member
            {'command':'speed','replay':'m.0a1b2c3d'}                        | missing-member
            {'command':'step','replay':'m.0a1b2c3d','count':0}               | wrong-member
            {'command':'rewind','replay':'m.0a1b2c3d'}                       | unknown-command
            {'command':'loop','replay':'m.0a1b2c3d','from':5}                | missing-member
            {'command':'loop','replay':'m.0a1b2c3d','from':5,'to':5}         | wrong-member
            {'command':'pause','replay':'m.0a1b2c3d','group':'0a1b2c3d'}     | wrong-member
            {'command':'pause','group':'x'}                                  | illegal-name
            {'command':'start','missions':[]}                                | wrong-member
            {'command':'start','missions':['a','a']}                         | wrong-member
            {'command':'start','missions':['a'],'mission':'b'}               | wrong-member
            {'command':'start','missions':['a','b'],'speed':'max'}           | wrong-member
            {'command':'start','missions':['a','b'],'topic':'data.a.replay.0a1b2c3d'} | wrong-member
            {'command':'start','mission':'a','topic':'data.a b.replay.0a1b2c3d'} | wrong-member
            {'command':'start','mission':'a','topic':'data.raw'}             | wrong-member
            {'command':'start','mission':'a','maxGap':'5'}                   | wrong-member
            """)
    void answersWhatIsNoRequestToAReplay(String request, String code) {
        String whole = request.replace("{'command'", "{'type':'request','command'");
        assertThat(refusal(Requests.replay(json(whole)))).isEqualTo(code);
    }

    /** A host has them for each device: two hundred bytes may ask for a gigabyte. */
    @Test
    void refusesSettingsThatAreTooLargeForSoManyDevices() {
        String request = "{'type':'request','command':'create','mission':'m','domain':'d','devices':"
                + "[{'type':'Robot','count':%d,'parameters':{'note':'" + "x".repeat(1000) + "'}}]}";

        assertThat(Requests.mission(json(request.formatted(4000)))).isInstanceOf(ParsedRequest.Request.class);
        assertThat(refusal(Requests.mission(json(request.formatted(5000))))).isEqualTo("too-large");
    }

    @Test
    void answersAnErrorWithTheIdAndWhatItIsAbout() {
        ParsedRequest<MissionCommand> parsedRequest = Requests.mission(
                json("{'type':'request','requestId':'r','command':'launch','mission':'m','domain':'a.b'}"));

        assertThat(parsedRequest).isInstanceOfSatisfying(ParsedRequest.Refused.class, refused -> {
            assertThat(refused.requestId()).isEqualTo("r");
            assertThat(new String(refused.answer().toBytes(), StandardCharsets.UTF_8))
                    .isEqualTo(
                            "{'type':'response','status':'error','error':'unknown-command','reason':\"there is no command "
                                            .replace('\'', '"')
                                    + "'launch' here, but create, start, stop, delete, add-devices, save-template, delete-template, rotate-credentials\","
                                    + "\"mission\":\"m\"}");
        });
    }

    private static String refusal(ParsedRequest<?> parsedRequest) {
        assertThat(parsedRequest).isInstanceOf(ParsedRequest.Refused.class);
        CommandResult answer = ((ParsedRequest.Refused<?>) parsedRequest).answer();
        assertThat(answer.json().path("reason").asText()).isNotBlank();
        return answer.error().orElseThrow();
    }

    private static byte[] json(String text) {
        return text.replace('\'', '"').getBytes(StandardCharsets.UTF_8);
    }
}
