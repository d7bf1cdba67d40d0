package io.furrow.model.control;

import java.time.Duration;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class AlarmRequestsTest {
    @Test
    void readsBackWrittenRequests() {
        for (AlarmCommand command : new AlarmCommand[] {
            new AlarmCommand.Acknowledge("collision-1", "ann"),
            new AlarmCommand.Close("collision-1", null),
            new AlarmCommand.Mute(new AlarmCommand.OfAlarm("collision-1"), Duration.ofHours(1)),
            new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, "urn:x"), Duration.ofDays(1)),
            new AlarmCommand.Unmute(new AlarmCommand.OfKind(AlarmKind.COLLISION, null))
        }) {
            assertThat(Requests.alarm(Requests.write("r", command)))
                    .isEqualTo(new ParsedRequest.Request<>("r", command));
        }
    }
}
