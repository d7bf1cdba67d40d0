package io.furrow.control.alarm;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.control.manager.KeptOutbox;
import io.furrow.control.manager.MapRecords;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StateJson;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RefusedException;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AlarmDeskTest {
    private static final long NOW = 1_700_000_000_000L;
    private static final Duration HOUR = Duration.ofHours(1);

    private final MapRecords<AlarmRecords.Mute> mutes = MapRecords.of(AlarmRecords.Mute.class);
    private final KeptOutbox outbox = new KeptOutbox();
    private final AlarmDesk desk = new AlarmDesk(
            new AlarmRecords(MapRecords.of(Alarm.class), MapRecords.of(String.class), mutes),
            new Sequence(MapRecords.of(Long.class)),
            outbox);

    @Test
    void showsAnAlarmAsClientsReadIt() {
        desk.raise(silent("urn:t:1"), NOW);

        assertThat(new String(outbox.compacted(Topics.ALARMS).get("silent-device-1"), StandardCharsets.UTF_8))
                .isEqualTo("""
                        {"alarm":"silent-device-1","kind":"silent-device","subject":"urn:t:1","severity":"minor","state":"open",\
                        "change":"opened","text":"it is silent","devices":[{"id":"urn:t:1","type":"Thermometer"}],\
                        "raised":1700000000000,"changed":1700000000000,"count":1,"sequence":1}""");
    }

    @Test
    void raisesOneAlarmHoweverOftenItsCauseIsSeen() {
        desk.raise(silent("urn:t:1"), NOW);
        desk.raise(silent("urn:t:1"), NOW + 1);
        desk.raise(silent("urn:t:2"), NOW + 2);
        assertThat(outbox.all()).hasSize(2);
        desk.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "it reports again", NOW + 3);
        assertThat(alarm("silent-device-1"))
                .returns(2, Alarm::count)
                .returns(AlarmState.CLOSED, Alarm::state)
                .returns("it reports again", Alarm::reason);
        desk.raise(silent("urn:t:1"), NOW + 4);
        assertThat(alarm("silent-device-4").state()).isEqualTo(AlarmState.OPEN);
    }

    @Test
    void goesFromOpenOverAcknowledgedToClosedAndNeverBack() throws Exception {
        desk.raise(silent("urn:t:1"), NOW);
        assertThat(desk.answer(acknowledge("silent-device-1"), NOW).status()).isEqualTo("acknowledged");
        assertThat(alarm("silent-device-1"))
                .returns(AlarmState.ACKNOWLEDGED, Alarm::state)
                .returns("ann", Alarm::acknowledgedBy);
        refused(ErrorCode.WRONG_STATE, acknowledge("silent-device-1"));
        desk.answer(new AlarmCommand.Close("silent-device-1", "bob"), NOW);
        assertThat(alarm("silent-device-1"))
                .returns("closed by bob", Alarm::reason)
                .returns("ann", Alarm::acknowledgedBy);
        refused(ErrorCode.WRONG_STATE, new AlarmCommand.Close("silent-device-1", "bob"));
        refused(ErrorCode.WRONG_STATE, acknowledge("silent-device-1"));
        refused(ErrorCode.UNKNOWN_ALARM, acknowledge("silent-device-2"));
    }

    @Test
    void closesByItselfWhatIsNotSeenAnyMoreWhereNothingTellsItsEnd() {
        Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, "s", "odd", List.of(), HOUR);
        desk.raise(cause, NOW);
        desk.raise(cause, NOW + 10);
        desk.passTime(NOW + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.OPEN);
        desk.passTime(NOW + 10 + HOUR.toMillis());
        assertThat(alarm("suspect-sensor-1").state()).isEqualTo(AlarmState.CLOSED);
    }

    @Test
    void mutesOneAlarmUntilItsTimeIsOver() throws Exception {
        desk.raise(silent("urn:t:1"), NOW);
        desk.answer(new AlarmCommand.Mute(new AlarmCommand.OfAlarm("silent-device-1"), HOUR), NOW);
        assertThat(alarm("silent-device-1").mutedUntil()).isEqualTo(NOW + HOUR.toMillis());
        desk.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "over", NOW);
        desk.raise(silent("urn:t:1"), NOW);
        assertThat(alarm("silent-device-4").mutedUntil()).isNull();

        desk.answer(new AlarmCommand.Mute(new AlarmCommand.OfAlarm("silent-device-4"), HOUR), NOW);
        desk.passTime(NOW + HOUR.toMillis());
        assertThat(alarm("silent-device-4"))
                .returns(null, Alarm::mutedUntil)
                .returns(Alarm.Change.UNMUTED, Alarm::change);
    }

    @Test
    void mutesAlarmsToComeOfAKindOrOfOneSubject() throws Exception {
        desk.answer(new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, "urn:t:1"), HOUR), NOW);
        desk.raise(silent("urn:t:1"), NOW + 1);
        desk.raise(silent("urn:t:2"), NOW + 1);
        assertThat(alarm("silent-device-1").mutedUntil()).isEqualTo(NOW + HOUR.toMillis());
        assertThat(alarm("silent-device-2").mutedUntil()).isNull();

        desk.answer(new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, null), HOUR), NOW + 2);
        assertThat(alarm("silent-device-2").mutedUntil()).isEqualTo(NOW + 2 + HOUR.toMillis());
        desk.answer(new AlarmCommand.Unmute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, null)), NOW + 3);
        assertThat(alarm("silent-device-1").mutedUntil()).isNull();
        assertThat(mutes.all()).hasSize(1);
        desk.passTime(NOW + HOUR.toMillis());
        assertThat(mutes.all()).isEmpty();
    }

    @Test
    void takesClosedAlarmsAwayAfterADay() {
        desk.raise(silent("urn:t:1"), NOW);
        desk.raise(silent("urn:t:2"), NOW);
        desk.end(AlarmKind.SILENT_DEVICE, "urn:t:1", "over", NOW);
        long day = AlarmDesk.CLOSED_KEPT.toMillis();
        desk.passTime(NOW + day - 1);
        assertThat(outbox.compacted(Topics.ALARMS)).hasSize(2);
        desk.passTime(NOW + day + 60_000);
        assertThat(outbox.compacted(Topics.ALARMS)).containsOnlyKeys("silent-device-2");
    }

    private static Cause silent(String device) {
        return new Cause(
                AlarmKind.SILENT_DEVICE,
                device,
                "it is silent",
                List.of(new Cause.Device(device, "Thermometer")),
                null);
    }

    private static AlarmCommand acknowledge(String alarm) {
        return new AlarmCommand.Acknowledge(alarm, "ann");
    }

    private Alarm alarm(String id) {
        return StateJson.read(outbox.compacted(Topics.ALARMS).get(id), Alarm.class);
    }

    private void refused(ErrorCode code, AlarmCommand command) {
        assertThatThrownBy(() -> desk.answer(command, NOW))
                .isInstanceOfSatisfying(
                        RefusedException.class, e -> assertThat(e.code()).isEqualTo(code));
    }
}
