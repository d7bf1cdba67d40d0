package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.Set;

import org.junit.jupiter.api.Test;

import io.furrow.control.manager.CapturingPublisher;
import io.furrow.control.manager.MapTable;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RejectedException;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AlarmCommandHandlerTest {
    private static final long NOW = 1_700_000_000_000L;
    private static final Duration HOUR = Duration.ofHours(1);

    private final MapTable<AlarmTables.Mute> mutes = MapTable.of(AlarmTables.Mute.class);
    private final CapturingPublisher publisher = new CapturingPublisher();
    private final AlarmCommandHandler handler = new AlarmCommandHandler(
            new AlarmTables(
                    MapTable.of(Alarm.class),
                    MapTable.of(String.class),
                    mutes,
                    MapTable.of(AlarmLimit.Group.class),
                    MapTable.of(AlarmLimit.Overflow.class)),
            new Sequence(MapTable.of(Long.class)),
            publisher);

    @Test
    void showsAnAlarmAsClientsReadIt() {
        handler.raise(silent("urn:t:1"), NOW);

        assertThat(new String(publisher.compacted(Topics.ALARMS).get("silent-device-1"), UTF_8))
                .isEqualTo("""
                        {"alarm":"silent-device-1","kind":"silent-device","subject":"urn:t:1","severity":"minor","state":"open",\
                        "change":"opened","text":"it is silent","devices":[{"id":"urn:t:1","type":"Thermometer"}],\
                        "raised":1700000000000,"changed":1700000000000,"count":1,"sequence":1,"seen":1700000000000}""");
    }

    @Test
    void raisesOneAlarmHoweverOftenItsCauseIsSeen() {
        handler.raise(silent("urn:t:1"), NOW);
        handler.raise(silent("urn:t:1"), NOW + 1);
        handler.raise(silent("urn:t:2"), NOW + 2);
        assertThat(publisher.all()).hasSize(2);
        handler.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "it reports again", NOW + 3);
        assertThat(alarm("silent-device-1"))
                .returns(2, alarm -> alarm.period().count())
                .returns(AlarmState.CLOSED, Alarm::state)
                .returns("it reports again", alarm -> alarm.handling().reason());
        handler.raise(silent("urn:t:1"), NOW + 4);
        assertThat(alarm("silent-device-4").state()).isEqualTo(AlarmState.OPEN);
    }

    @Test
    void goesFromOpenOverAcknowledgedToClosedAndNeverBack() throws Exception {
        handler.raise(silent("urn:t:1"), NOW);
        assertThat(handler.answer(acknowledge("silent-device-1"), NOW).status()).isEqualTo("acknowledged");
        assertThat(alarm("silent-device-1"))
                .returns(AlarmState.ACKNOWLEDGED, Alarm::state)
                .returns("ann", alarm -> alarm.handling().acknowledgedBy());
        refused(ErrorCode.WRONG_STATE, acknowledge("silent-device-1"));
        handler.answer(
                new AlarmCommand.Close("silent-device-1", "bob"), NOW + AlarmStateMachine.CAUSE_LASTS.toMillis());
        assertThat(alarm("silent-device-1"))
                .returns("closed by bob", alarm -> alarm.handling().reason())
                .returns("ann", alarm -> alarm.handling().acknowledgedBy());
        refused(ErrorCode.WRONG_STATE, new AlarmCommand.Close("silent-device-1", "bob"));
        refused(ErrorCode.WRONG_STATE, acknowledge("silent-device-1"));
        refused(ErrorCode.UNKNOWN_ALARM, acknowledge("silent-device-2"));
    }

    @Test
    void closesByItselfWhatIsNotSeenAnyMoreWhereNothingReportsItsEnd() {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        handler.raise(cause, NOW);
        handler.raise(cause, NOW + 10);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.OPEN);
        handler.passTime(NOW + 10 + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.CLOSED);
    }

    @Test
    void namesTheTypesInTheNextAlarmOfAResultThatNamedNone() {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        Cause newer = cause.identifiedBy("farm|/|Thermometer|s");
        handler.raise(cause.identifiedBy("farm|/||s"), NOW);
        handler.raise(newer, NOW + 10);
        assertThat(current()).hasSize(1);
        handler.end(AlarmKind.SUSPECT_SENSOR, newer.identity(), "over", NOW + 20);
        handler.raise(newer, NOW + 30);
        assertThat(current()).singleElement().returns(newer.identity(), Alarm::identity);
    }

    @Test
    void countsACauseOnceOfWhichAResultNamedNoTypes() {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 3; i++) {
            handler.raise(pair(i).identifiedBy("farm|/||pair" + i), NOW);
        }
        String last = "pair" + (AlarmLimit.MAX_ALARMS + 2);
        handler.raise(pair(AlarmLimit.MAX_ALARMS + 2).identifiedBy("farm|/|ROBOT ROBOT|" + last), NOW + 1);
        handler.passTime(NOW + 20_000);
        Alarm crowd = alarm("collision-" + (AlarmLimit.MAX_ALARMS + 1));
        assertThat(crowd.extent().affected()).isEqualTo(3);

        handler.end(AlarmKind.COLLISION, "farm|/|ROBOT ROBOT|" + last, "over", NOW + 20_001);
        handler.endAt(AlarmKind.COLLISION, "farm|/|ROBOT ROBOT|pair" + AlarmLimit.MAX_ALARMS, NOW + 30_000);
        handler.passTime(NOW + 40_000);
        assertThat(alarm(crowd.alarm()).extent().affected()).isEqualTo(1);
    }

    @Test
    void goesOnWithAnAlarmOfAResultThatNamedNoType() {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        handler.raise(cause.identifiedBy("farm|/||s"), NOW);
        handler.raise(cause.identifiedBy("farm|/|Thermometer|s"), NOW + 10);
        assertThat(current()).hasSize(1);
        handler.end(AlarmKind.SUSPECT_SENSOR, "farm|/|Thermometer|s", "over", NOW + 20);
        assertThat(current()).isEmpty();
    }

    @Test
    void mutesASubjectOfOneTenantOrOfAll() throws Exception {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        muteSensor("other|/|Thermometer|s");
        handler.raise(cause.identifiedBy("farm|/|Thermometer|s"), NOW);
        handler.raise(cause.identifiedBy("other|/|Thermometer|s"), NOW);
        assertThat(current()).extracting(alarm -> alarm.isMuted(NOW)).containsExactly(false, true);
        muteSensor("s");
        assertThat(current()).allMatch(alarm -> alarm.isMuted(NOW));
    }

    private void muteSensor(String subject) throws Exception {
        handler.answer(new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SUSPECT_SENSOR, subject), HOUR), NOW);
    }

    @Test
    void refusesToCloseByHandWhatWasSeenWithinTheLastMinute() throws Exception {
        handler.raise(silent("urn:t:1"), NOW);
        long later = NOW + AlarmStateMachine.CAUSE_LASTS.toMillis() - 1;
        assertThatThrownBy(() -> handler.answer(new AlarmCommand.Close("silent-device-1", null), later))
                .isInstanceOf(RejectedException.class)
                .hasMessage("alarm 'silent-device-1' closes when its cause is over: it is silent (seen 59 s ago)."
                        + " Acknowledge it, or mute it for a while.");
        handler.raise(silent("urn:t:1"), later);
        assertThatThrownBy(() -> handler.answer(new AlarmCommand.Close("silent-device-1", null), later + 1))
                .isInstanceOf(RejectedException.class);
        assertThat(alarm("silent-device-1").state()).isEqualTo(AlarmState.OPEN);
        handler.answer(
                new AlarmCommand.Close("silent-device-1", null), later + AlarmStateMachine.CAUSE_LASTS.toMillis());
        handler.raise(silent("urn:t:1"), later + AlarmStateMachine.CAUSE_LASTS.toMillis());
        assertThat(publisher.compacted(Topics.ALARMS)).hasSize(2);
    }

    @Test
    void updatesAGroupAlarmAtMostEveryTenSeconds() {
        handler.report(many(1), null, NOW);
        handler.report(many(2), null, NOW + 9_999);
        assertThat(alarm("silent-device-1").extent().affected()).isEqualTo(1);
        handler.report(many(2), null, NOW + 10_000);
        assertThat(alarm("silent-device-1"))
                .returns(2, alarm -> alarm.extent().affected())
                .returns(Alarm.Change.UPDATED, Alarm::change)
                .returns("2 are silent", alarm -> alarm.description().text());
        handler.report(many(2), null, NOW + 30_000);
        assertThat(publisher.all()).hasSize(2);
    }

    @Test
    void reportsWhichAlarmInhibitsAnotherAndWhenNoLonger() {
        Cause farm = Cause.ofMany(AlarmKind.SILENT_FARM, "data.raw", "all", List.of(), new Cause.Extent(9, 9));
        handler.report(farm, null, NOW);
        handler.report(many(3), farm, NOW);
        assertThat(alarm("silent-device-2"))
                .returns("silent-farm-1", Alarm::inhibitedBy)
                .returns(Alarm.Change.OPENED, Alarm::change);
        handler.report(many(3), null, NOW + 1);
        assertThat(alarm("silent-device-2"))
                .returns(null, Alarm::inhibitedBy)
                .returns(Alarm.Change.UPDATED, Alarm::change);
        handler.endOthers(Set.of(AlarmKind.SILENT_FARM, AlarmKind.SILENT_DEVICE), List.of(many(3)), "over", NOW + 2);
        assertThat(alarm("silent-farm-1").state()).isEqualTo(AlarmState.CLOSED);
        assertThat(alarm("silent-device-2").state()).isEqualTo(AlarmState.OPEN);
    }

    @Test
    void countsThePairsOfAMissionBeyondTwenty() {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 30; i++) {
            handler.raise(pair(i), NOW);
        }
        handler.passTime(NOW + 1000);
        assertThat(publisher.compacted(Topics.ALARMS)).hasSize(AlarmLimit.MAX_ALARMS + 1);
        Alarm crowd = alarm("collision-" + (AlarmLimit.MAX_ALARMS + 1));
        assertThat(crowd)
                .returns("urn:ngsi-ld:Mission:m", Alarm::subject)
                .returns(30, alarm -> alarm.extent().affected())
                .returns(
                        "30 more pairs of mission m are too close",
                        alarm -> alarm.description().text());
        for (int i = AlarmLimit.MAX_ALARMS; i < AlarmLimit.MAX_ALARMS + 30; i++) {
            handler.end(AlarmKind.COLLISION, "pair" + i, "over", NOW);
        }
        handler.passTime(NOW + 2000);
        assertThat(alarm(crowd.alarm()).state()).isEqualTo(AlarmState.CLOSED);
        handler.end(AlarmKind.COLLISION, "pair0", "over", NOW);
        handler.raise(pair(99), NOW);
        assertThat(StateJson.read(
                                publisher.all().get(publisher.all().size() - 1).value(), Alarm.class)
                        .subject())
                .isEqualTo("pair99");
    }

    @Test
    void closesAGroupAlarmByHandOnceNoneOfItsCausesIsReportedAnyMore() throws Exception {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 2; i++) {
            handler.raise(pair(i), NOW);
        }
        handler.passTime(NOW + 1_000);
        String crowd = "collision-" + (AlarmLimit.MAX_ALARMS + 1);
        handler.raise(pair(AlarmLimit.MAX_ALARMS), NOW + 50_000);
        AlarmCommand close = new AlarmCommand.Close(crowd, "ann");
        assertThatThrownBy(() -> handler.answer(close, NOW + 70_000)).isInstanceOf(RejectedException.class);

        handler.answer(close, NOW + 110_000);
        handler.passTime(NOW + 120_000);

        assertThat(alarm(crowd).state()).isEqualTo(AlarmState.CLOSED);
        assertThat(current()).hasSize(AlarmLimit.MAX_ALARMS);
    }

    @Test
    void forgetsCountedCausesThatAreOverByThemselves() {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 5; i++) {
            handler.raise(new Cause(AlarmKind.PREDICTED_ENCOUNTER, "p" + i, "x", List.of(), HOUR).inGroup("g"), NOW);
        }
        handler.passTime(NOW + 1000);
        assertThat(current()).hasSize(AlarmLimit.MAX_ALARMS + 1);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(current()).isEmpty();
    }

    @Test
    void storesNoMoreThanTenThousandClosedAlarms() {
        for (int i = 0; i < AlarmCommandHandler.MAX_CLOSED + 10; i++) {
            handler.raise(silent("urn:t:1"), NOW + i);
            handler.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "over", NOW + i);
        }
        handler.passTime(NOW + 100_000);
        assertThat(publisher.compacted(Topics.ALARMS))
                .hasSize(AlarmCommandHandler.MAX_CLOSED)
                .doesNotContainKey("silent-device-1");
    }

    @Test
    void mutesOneAlarmUntilItsTimeIsOver() throws Exception {
        handler.raise(silent("urn:t:1"), NOW);
        handler.answer(new AlarmCommand.Mute(new AlarmCommand.OfAlarm("silent-device-1"), HOUR), NOW);
        assertThat(alarm("silent-device-1").handling().mutedUntil()).isEqualTo(NOW + HOUR.toMillis());
        handler.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "over", NOW);
        handler.raise(silent("urn:t:1"), NOW);
        assertThat(alarm("silent-device-4").handling().mutedUntil()).isNull();

        handler.answer(new AlarmCommand.Mute(new AlarmCommand.OfAlarm("silent-device-4"), HOUR), NOW);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(alarm("silent-device-4"))
                .returns(null, alarm -> alarm.handling().mutedUntil())
                .returns(Alarm.Change.UNMUTED, Alarm::change);
    }

    @Test
    void refusesToMuteMoreSubjectsThanItRemembers() throws Exception {
        for (int i = 0; i < Limits.MUTES; i++) {
            String key = Cause.key(AlarmKind.SILENT_DEVICE, "urn:t:" + i);
            mutes.put(key, new AlarmTables.Mute(key, NOW + HOUR.toMillis()));
        }

        assertThatThrownBy(() -> handler.answer(mute("urn:t:further"), NOW))
                .isInstanceOfSatisfying(
                        RejectedException.class,
                        refused -> assertThat(refused.code()).isEqualTo(ErrorCode.QUOTA_EXCEEDED));
        handler.answer(mute("urn:t:0"), NOW + 1);
        handler.passTime(NOW + HOUR.toMillis());
        handler.answer(mute("urn:t:further"), NOW + HOUR.toMillis());
        assertThat(mutes.all()).hasSize(2);
    }

    private static AlarmCommand mute(String subject) {
        return new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, subject), HOUR);
    }

    @Test
    void mutesAlarmsToComeOfAKindOrOfOneSubject() throws Exception {
        handler.answer(new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, "urn:t:1"), HOUR), NOW);
        handler.raise(silent("urn:t:1"), NOW + 1);
        handler.raise(silent("urn:t:2"), NOW + 1);
        assertThat(alarm("silent-device-1").handling().mutedUntil()).isEqualTo(NOW + HOUR.toMillis());
        assertThat(alarm("silent-device-2").handling().mutedUntil()).isNull();

        handler.answer(new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, null), HOUR), NOW + 2);
        assertThat(alarm("silent-device-2").handling().mutedUntil()).isEqualTo(NOW + 2 + HOUR.toMillis());
        handler.answer(new AlarmCommand.Unmute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, null)), NOW + 3);
        assertThat(alarm("silent-device-1").handling().mutedUntil()).isNull();
        assertThat(mutes.all()).hasSize(1);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(mutes.all()).isEmpty();
    }

    @Test
    void takesClosedAlarmsAwayAfterADay() {
        handler.raise(silent("urn:t:1"), NOW);
        handler.raise(silent("urn:t:2"), NOW);
        handler.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "over", NOW);
        long day = AlarmCommandHandler.CLOSED_RETENTION.toMillis();
        handler.passTime(NOW + day - 1);
        assertThat(publisher.compacted(Topics.ALARMS)).hasSize(2);
        handler.passTime(NOW + day + 60_000);
        assertThat(publisher.compacted(Topics.ALARMS)).containsOnlyKeys("silent-device-2");
    }

    private static Cause silent(String device) {
        return new Cause(
                AlarmKind.SILENT_DEVICE,
                device,
                "it is silent",
                List.of(new Cause.AffectedDevice(device, "Thermometer", null, null)),
                null);
    }

    private static Cause many(int affected) {
        return Cause.ofMany(
                AlarmKind.SILENT_DEVICE, "g", affected + " are silent", List.of(), new Cause.Extent(affected, 40));
    }

    private static Cause pair(int number) {
        return new Cause(AlarmKind.COLLISION, "pair" + number, "too close", List.of(), null)
                .inGroup(AlarmGroup.of("m", ""));
    }

    private List<Alarm> current() {
        return publisher.compacted(Topics.ALARMS).values().stream()
                .map(json -> StateJson.read(json, Alarm.class))
                .filter(alarm -> alarm.state() != AlarmState.CLOSED)
                .toList();
    }

    private static AlarmCommand acknowledge(String alarm) {
        return new AlarmCommand.Acknowledge(alarm, "ann");
    }

    private Alarm alarm(String id) {
        return StateJson.read(publisher.compacted(Topics.ALARMS).get(id), Alarm.class);
    }

    private void refused(ErrorCode code, AlarmCommand command) {
        assertThatThrownBy(() -> handler.answer(command, NOW))
                .isInstanceOfSatisfying(
                        RejectedException.class, e -> assertThat(e.code()).isEqualTo(code));
    }
}
