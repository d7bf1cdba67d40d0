package io.furrow.control.alarm;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RejectedException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AlarmMuteTest extends AlarmHandlerFixture {
    @Test
    void mutesASubjectInOneOrAllTenants() throws Exception {
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
    void mutesAnAlarmForATime() throws Exception {
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
    void endsMutesOfWhenTheClockWasAhead() throws Exception {
        long ahead = NOW + 1_000 * HOUR.toMillis();
        handler.raise(silent("urn:t:1"), ahead);
        handler.answer(new AlarmCommand.Mute(new AlarmCommand.OfAlarm("silent-device-1"), HOUR), ahead);
        handler.answer(mute("urn:t:2"), ahead);
        for (long now : new long[] {NOW, NOW + HOUR.toMillis() - 1}) {
            handler.passTime(now);
            assertThat(handler.isMuted(AlarmKind.SILENT_DEVICE, "urn:t:2", now)).isTrue();
            assertThat(alarm("silent-device-1").isMuted(now)).isTrue();
        }
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(handler.isMuted(AlarmKind.SILENT_DEVICE, "urn:t:2", NOW + HOUR.toMillis()))
                .isFalse();
        assertThat(alarm("silent-device-1").handling().mutedUntil()).isNull();
    }

    @Test
    void limitsTheNumberOfMutes() throws Exception {
        for (int i = 0; i < Limits.MUTES; i++) {
            String key = Cause.key(AlarmKind.SILENT_DEVICE, "urn:t:" + i);
            mutes.put(key, new AlarmTables.Mute(key, NOW + HOUR.toMillis(), null));
        }

        assertThatThrownBy(() -> handler.answer(mute("urn:t:further"), NOW))
                .isInstanceOfSatisfying(
                        RejectedException.class,
                        rejected -> assertThat(rejected.code()).isEqualTo(ErrorCode.QUOTA_EXCEEDED));
        handler.answer(mute("urn:t:0"), NOW + 1);
        handler.passTime(NOW + HOUR.toMillis());
        handler.answer(mute("urn:t:further"), NOW + HOUR.toMillis());
        assertThat(mutes.all()).hasSize(2);
    }

    private static AlarmCommand mute(String subject) {
        return new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, subject), HOUR);
    }

    @Test
    void mutesFutureAlarmsOfAKindOrSubject() throws Exception {
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
}
