package io.furrow.control.alarm;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.time.ZoneOffset;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.control.audit.AuditEntry;
import io.furrow.model.control.AlarmKind;

import static org.assertj.core.api.Assertions.assertThat;

class StopRobotsTest {
    private static final long NOW = 1_700_000_000_000L;

    private final List<String> sent = new ArrayList<>();
    private final List<AuditEntry> audited = new ArrayList<>();
    private int failing;

    private final StopRobots robots = new StopRobots(
            StopRobots.Settings.of((device, type, command, value) -> {
                sent.add("%s %s %s".formatted(device, type, command));
                if (failing-- > 0) {
                    throw new IOException("The context broker is away.");
                }
            }),
            audited::add,
            Clock.fixed(Instant.ofEpochMilli(NOW), ZoneOffset.UTC));

    @Test
    void stopsTheRobotsOfAPredictedEncounterAndNothingElse() throws Exception {
        robots.take(alarm(NOW, "ROBOT", "Camera"));
        assertThat(sent).containsExactly("urn:1 ROBOT Stop");
        assertThat(audited).hasSize(1);
        assertThat(audited.get(0))
                .returns("alarms", AuditEntry::user)
                .returns("Stop", AuditEntry::command)
                .returns("sent", AuditEntry::result);
        assertThat(audited.get(0).about()).hasToString("{\"device\":\"urn:1\",\"alarm\":\"predicted-encounter-7\"}");

        Cause collision = new Cause(AlarmKind.COLLISION, "a", "x", List.of(new Cause.Device("r", "ROBOT")), null);
        robots.take(Alarm.raised(collision, null, 8, NOW));
        robots.take(alarm(NOW, "ROBOT", "ROBOT").become(AlarmState.ACKNOWLEDGED, "ann", null, NOW));
        assertThat(sent).hasSize(1);
    }

    @Test
    void triesAgainAndSaysWhatBecameOfIt() throws Exception {
        failing = StopRobots.ATTEMPTS - 1;
        robots.take(alarm(NOW, "Robot", "Camera"));
        assertThat(sent).hasSize(StopRobots.ATTEMPTS);
        failing = StopRobots.ATTEMPTS;
        robots.take(alarm(NOW, "Robot", "Camera"));
        assertThat(audited).extracting(AuditEntry::result).containsExactly("sent", "error");
        assertThat(audited.get(1).reason()).isEqualTo("The context broker is away.");
    }

    @Test
    void stopsNobodyForAnOldPrediction() throws Exception {
        Duration fresh = StopRobots.FRESH;
        robots.take(alarm(NOW - fresh.toMillis() - 1, "Robot", "Robot"));
        assertThat(sent).isEmpty();
        assertThat(audited)
                .hasSize(2)
                .allSatisfy(entry -> assertThat(entry.reason()).isEqualTo("the prediction was older than 10 s"));
        robots.take(alarm(NOW - fresh.toMillis(), "Robot", "Robot"));
        assertThat(sent).hasSize(2);
    }

    @Test
    void saysThatItCouldNotStopWhatItDoesNotKnow() throws Exception {
        robots.take(alarm(NOW, null, "Camera"));
        assertThat(sent).isEmpty();
        assertThat(audited).hasSize(1);
        assertThat(audited.get(0).result()).isEqualTo("error");
    }

    private static Alarm alarm(long raised, String firstType, String secondType) {
        List<Cause.Device> devices =
                List.of(new Cause.Device("urn:1", firstType), new Cause.Device("urn:2", secondType));
        Cause cause = new Cause(AlarmKind.PREDICTED_ENCOUNTER, "urn:1-urn:2", "close", devices, null);
        return Alarm.raised(cause, null, 7, raised);
    }
}
