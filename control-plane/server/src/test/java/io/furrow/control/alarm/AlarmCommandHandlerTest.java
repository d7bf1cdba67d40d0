package io.furrow.control.alarm;

import java.util.List;
import java.util.Set;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AlarmCommandHandlerTest extends AlarmHandlerFixture {
    @Test
    void publishesAnAlarmAsJson() {
        handler.raise(silent("urn:t:1"), NOW);

        assertThat(new String(publisher.compacted(Topics.ALARMS).get("silent-device-1"), UTF_8))
                .isEqualTo("""
                        {"alarm":"silent-device-1","kind":"silent-device","subject":"urn:t:1","severity":"minor","state":"open",\
                        "change":"opened","text":"it is silent","devices":[{"id":"urn:t:1","type":"Thermometer"}],\
                        "raised":1700000000000,"changed":1700000000000,"count":1,"sequence":1,"seen":1700000000000}""");
    }

    @Test
    void raisesOneAlarmForARepeatedCause() {
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
    void followsTheLifeCycle() throws Exception {
        handler.raise(silent("urn:t:1"), NOW);
        assertThat(handler.answer(acknowledge("silent-device-1"), NOW).status()).isEqualTo("acknowledged");
        assertThat(alarm("silent-device-1"))
                .returns(AlarmState.ACKNOWLEDGED, Alarm::state)
                .returns("ann", alarm -> alarm.handling().acknowledgedBy());
        assertRejected(ErrorCode.WRONG_STATE, acknowledge("silent-device-1"));
        handler.answer(
                new AlarmCommand.Close("silent-device-1", "bob"), NOW + AlarmStateMachine.ACTIVE_TIMEOUT.toMillis());
        assertThat(alarm("silent-device-1"))
                .returns("closed by bob", alarm -> alarm.handling().reason())
                .returns("ann", alarm -> alarm.handling().acknowledgedBy());
        assertRejected(ErrorCode.WRONG_STATE, new AlarmCommand.Close("silent-device-1", "bob"));
        assertRejected(ErrorCode.WRONG_STATE, acknowledge("silent-device-1"));
        assertRejected(ErrorCode.UNKNOWN_ALARM, acknowledge("silent-device-2"));
    }

    @Test
    void closesAnAlarmThatExpires() {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        handler.raise(cause, NOW);
        handler.raise(cause, NOW + 10);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.OPEN);
        handler.passTime(NOW + 10 + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.CLOSED);
    }

    @Test
    void closesAnAlarmOfWhenTheClockWasAhead() throws Exception {
        long ahead = NOW + 2 * HOUR.toMillis();
        handler.raise(new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR), ahead);
        handler.raise(silent("urn:t:1"), ahead);
        handler.passTime(NOW);
        handler.passTime(NOW + HOUR.toMillis() - 1);
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.OPEN);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.CLOSED);

        handler.raise(silent("urn:t:2"), ahead);
        handler.answer(new AlarmCommand.Close(current().get(1).alarm(), "bob"), NOW);
        assertThat(current()).hasSize(1);
    }

    @Test
    void updatesAGroupAlarmOfWhenTheClockWasAhead() {
        handler.report(many(3), null, NOW + HOUR.toMillis());
        handler.report(many(4), null, NOW);
        assertThat(current()).singleElement().returns(4, alarm -> alarm.extent().affected());
    }

    @Test
    void addsTypesToTheNextAlarmOfAResultWithoutTypes() {
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
    void continuesAnAlarmOfAResultWithoutTypes() {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        handler.raise(cause.identifiedBy("farm|/||s"), NOW);
        handler.raise(cause.identifiedBy("farm|/|Thermometer|s"), NOW + 10);
        assertThat(current()).hasSize(1);
        handler.end(AlarmKind.SUSPECT_SENSOR, "farm|/|Thermometer|s", "over", NOW + 20);
        assertThat(current()).isEmpty();
    }

    @Test
    void rejectsClosingAnActiveCause() throws Exception {
        handler.raise(silent("urn:t:1"), NOW);
        long later = NOW + AlarmStateMachine.ACTIVE_TIMEOUT.toMillis() - 1;
        assertThatThrownBy(() -> handler.answer(new AlarmCommand.Close("silent-device-1", null), later))
                .isInstanceOf(RejectedException.class)
                .hasMessage("alarm 'silent-device-1' closes when its cause is over: it is silent (seen 59 s ago)."
                        + " Acknowledge it, or mute it for a while.");
        handler.raise(silent("urn:t:1"), later);
        assertThatThrownBy(() -> handler.answer(new AlarmCommand.Close("silent-device-1", null), later + 1))
                .isInstanceOf(RejectedException.class);
        assertThat(alarm("silent-device-1").state()).isEqualTo(AlarmState.OPEN);
        handler.answer(
                new AlarmCommand.Close("silent-device-1", null), later + AlarmStateMachine.ACTIVE_TIMEOUT.toMillis());
        handler.raise(silent("urn:t:1"), later + AlarmStateMachine.ACTIVE_TIMEOUT.toMillis());
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
    void publishesInhibitionAndItsEnd() {
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
    void limitsTheNumberOfClosedAlarms() {
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
    void removesClosedAlarmsAfterADay() {
        handler.raise(silent("urn:t:1"), NOW);
        handler.raise(silent("urn:t:2"), NOW);
        handler.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "over", NOW);
        long day = AlarmCommandHandler.CLOSED_RETENTION.toMillis();
        handler.passTime(NOW + day - 1);
        assertThat(publisher.compacted(Topics.ALARMS)).hasSize(2);
        handler.passTime(NOW + day + 60_000);
        assertThat(publisher.compacted(Topics.ALARMS)).containsOnlyKeys("silent-device-2");
    }

    private static Cause many(int affected) {
        return Cause.ofMany(
                AlarmKind.SILENT_DEVICE, "g", affected + " are silent", List.of(), new Cause.Extent(affected, 40));
    }

    private static AlarmCommand acknowledge(String alarm) {
        return new AlarmCommand.Acknowledge(alarm, "ann");
    }

    private void assertRejected(ErrorCode code, AlarmCommand command) {
        assertThatThrownBy(() -> handler.answer(command, NOW))
                .isInstanceOfSatisfying(
                        RejectedException.class, e -> assertThat(e.code()).isEqualTo(code));
    }
}
