package io.furrow.control.alarm;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.RejectedException;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AlarmLimitTest extends AlarmHandlerFixture {
    @Test
    void matchesCountedCausesWithAndWithoutTypes() {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 3; i++) {
            handler.raise(pair(i).identifiedBy("farm|/||pair" + i), NOW);
        }
        String last = "pair" + (AlarmLimit.MAX_ALARMS + 2);
        handler.raise(pair(AlarmLimit.MAX_ALARMS + 2).identifiedBy("farm|/|ROBOT ROBOT|" + last), NOW + 1);
        handler.passTime(NOW + 20_000);
        Alarm group = alarm("collision-" + (AlarmLimit.MAX_ALARMS + 1));
        assertThat(group.extent().affected()).isEqualTo(3);

        handler.end(AlarmKind.COLLISION, "farm|/|ROBOT ROBOT|" + last, "over", NOW + 20_001);
        handler.endAt(AlarmKind.COLLISION, "farm|/|ROBOT ROBOT|pair" + AlarmLimit.MAX_ALARMS, NOW + 30_000);
        handler.passTime(NOW + 40_000);
        assertThat(alarm(group.alarm()).extent().affected()).isEqualTo(1);
    }

    @Test
    void forgetsCountedCausesOfWhenTheClockWasAhead() {
        long ahead = NOW + HOUR.toMillis() * 48;
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 3; i++) {
            Cause lasting = new Cause(AlarmKind.COLLISION, "pair" + i, "too close", List.of(), HOUR);
            handler.raise(lasting.inGroup("urn:ngsi-ld:Mission:m"), ahead);
        }
        handler.passTime(ahead);
        assertThat(current()).hasSize(AlarmLimit.MAX_ALARMS + 1);
        handler.passTime(NOW);
        handler.passTime(NOW + HOUR.toMillis() * 24);
        assertThat(current()).isEmpty();
    }

    @Test
    void countsPairsBeyondTheLimit() {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 30; i++) {
            handler.raise(pair(i), NOW);
        }
        handler.passTime(NOW + 1000);
        assertThat(publisher.compacted(Topics.ALARMS)).hasSize(AlarmLimit.MAX_ALARMS + 1);
        Alarm group = alarm("collision-" + (AlarmLimit.MAX_ALARMS + 1));
        assertThat(group)
                .returns("urn:ngsi-ld:Mission:m", Alarm::subject)
                .returns(30, alarm -> alarm.extent().affected())
                .returns(
                        "30 more pairs of mission m are too close",
                        alarm -> alarm.description().text());
        for (int i = AlarmLimit.MAX_ALARMS; i < AlarmLimit.MAX_ALARMS + 30; i++) {
            handler.end(AlarmKind.COLLISION, "pair" + i, "over", NOW);
        }
        handler.passTime(NOW + 2000);
        assertThat(alarm(group.alarm()).state()).isEqualTo(AlarmState.CLOSED);
        handler.end(AlarmKind.COLLISION, "pair0", "over", NOW);
        handler.raise(pair(99), NOW);
        assertThat(StateJson.read(
                                publisher.all().get(publisher.all().size() - 1).value(), Alarm.class)
                        .subject())
                .isEqualTo("pair99");
    }

    @Test
    void allowsClosingAGroupAlarmWithoutActiveCauses() throws Exception {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 2; i++) {
            handler.raise(pair(i), NOW);
        }
        handler.passTime(NOW + 1_000);
        String group = "collision-" + (AlarmLimit.MAX_ALARMS + 1);
        handler.raise(pair(AlarmLimit.MAX_ALARMS), NOW + 50_000);
        AlarmCommand close = new AlarmCommand.Close(group, "ann");
        assertThatThrownBy(() -> handler.answer(close, NOW + 70_000)).isInstanceOf(RejectedException.class);

        handler.answer(close, NOW + 110_000);
        handler.passTime(NOW + 120_000);

        assertThat(alarm(group).state()).isEqualTo(AlarmState.CLOSED);
        assertThat(current()).hasSize(AlarmLimit.MAX_ALARMS);
    }

    @Test
    void dropsExpiredCountedCauses() {
        for (int i = 0; i < AlarmLimit.MAX_ALARMS + 5; i++) {
            handler.raise(new Cause(AlarmKind.PREDICTED_ENCOUNTER, "p" + i, "x", List.of(), HOUR).inGroup("g"), NOW);
        }
        handler.passTime(NOW + 1000);
        assertThat(current()).hasSize(AlarmLimit.MAX_ALARMS + 1);
        handler.passTime(NOW + HOUR.toMillis());
        assertThat(current()).isEmpty();
    }

    private static Cause pair(int number) {
        return new Cause(AlarmKind.COLLISION, "pair" + number, "too close", List.of(), null)
                .inGroup(AlarmGroup.of("m", ""));
    }
}
