package io.furrow.model.control;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class RequestsTest {
    /** The WeLASER dashboard sends this. */
    @Test
    void readsARequestWithoutCommandAsANewDomain() {
        assertThat(Requests.domain(json("{'type':'request','domain':'canary'}")))
                .isEqualTo(new ParsedRequest.Request<>(null, new DomainCommand.Create("canary", DomainDetails.NONE)));
    }

    @Test
    void readsTheOriginalRequestsForMissionsAndReplays() {
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
    void ignoresResponsesAndRecordsWithoutAValue() {
        assertThat(Requests.domain(null)).isEqualTo(new ParsedRequest.Passed<>());
        assertThat(Requests.domain(CommandResult.of("created").to("r").toBytes()))
                .isEqualTo(new ParsedRequest.Passed<>());
        assertThat(Requests.domain(json("{'type':'response'}"))).isEqualTo(new ParsedRequest.Passed<>());
    }

    /** A host stores the settings for each device, so two hundred bytes may expand to a gigabyte. */
    @Test
    void rejectsSettingsTooLargeForManyDevices() {
        String request = "{'type':'request','command':'create','mission':'m','domain':'d','devices':"
                + "[{'type':'Robot','count':%d,'parameters':{'note':'" + "x".repeat(1000) + "'}}]}";

        assertThat(Requests.mission(json(request.formatted(4000)))).isInstanceOf(ParsedRequest.Request.class);
        assertThat(refusal(Requests.mission(json(request.formatted(5000))))).isEqualTo("too-large");
    }

    @ParameterizedTest
    @CsvSource({"CEL, ", "°F, ", "km/h, ", "degrees Fahrenheit, ", "<b>, wrong-member", "a;b, wrong-member"})
    void acceptsUnitsAsCodesAndAsTheyAreSpelled(String unit, String refusal) {
        ParsedRequest<MissionCommand> request = Requests.mission(json(
                ("{'type':'request','command':'create','mission':'m','domain':'d','devices':[{'type':'Probe','attributes':"
                                + "[{'name':'Temperature','unit':'%s'}]}]}")
                        .formatted(unit)));

        if (refusal == null) {
            assertThat(request).isInstanceOf(ParsedRequest.Request.class);
        } else {
            assertThat(refusal(request)).isEqualTo(refusal);
        }
    }

    @Test
    void answersAnErrorWithTheIdAndTheSubject() {
        ParsedRequest<MissionCommand> parsedRequest = Requests.mission(
                json("{'type':'request','requestId':'r','command':'launch','mission':'m','domain':'a.b'}"));

        assertThat(parsedRequest).isInstanceOfSatisfying(ParsedRequest.Refused.class, rejected -> {
            assertThat(rejected.requestId()).isEqualTo("r");
            assertThat(new String(rejected.answer().toBytes(), UTF_8))
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
        return text.replace('\'', '"').getBytes(UTF_8);
    }
}
