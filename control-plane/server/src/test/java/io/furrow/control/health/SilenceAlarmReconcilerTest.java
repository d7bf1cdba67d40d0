package io.furrow.control.health;

import java.time.Duration;
import java.util.Optional;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmHandlerFixture;
import io.furrow.control.manager.CapturingPublisher;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class SilenceAlarmReconcilerTest {
    private static final long NOW = 1_700_000_000_000L;
    private static final long HOUR = 3_600_000;

    private final CapturingPublisher publisher = new CapturingPublisher();
    private final AlarmCommandHandler alarms = AlarmHandlerFixture.writingTo(publisher);

    @Test
    void retainsTheFarmAlarmAfterARestartUntilReportsArrive() {
        silent().reconcile(NOW - HOUR, NOW);
        assertThat(farm()).contains("nothing arrives");

        SilenceAlarmReconciler restarted = silent();
        for (long now = NOW + HOUR; now < NOW + HOUR + 60_000; now += 1_000) {
            restarted.reconcile(NOW + HOUR, now);
            assertThat(farm()).contains("nothing arrives");
        }

        restarted.reported(NOW + HOUR + 60_000);
        restarted.reconcile(NOW + HOUR, NOW + HOUR + 60_000);
        assertThat(farm()).contains("reports arrive");
    }

    @Test
    void raisesTheFarmAlarmWithinItsTimeWhenTheClockIsSetBack() {
        SilenceAlarmReconciler silence = silent();
        silence.reported(NOW + 2 * HOUR);
        silence.reconcile(NOW - HOUR, NOW);
        assertThat(farm()).isEmpty();
        silence.reconcile(NOW - HOUR, NOW + 40_000);
        assertThat(farm()).contains("nothing arrives");
    }

    @ParameterizedTest
    @ValueSource(strings = {"%s", "|/|%s", "|/|Thermometer|%s"})
    void ignoresADeviceThatIsMutedByIdOrIdentity(String form) throws Exception {
        for (int i = 0; i < 5; i++) {
            String muted = form.formatted("urn:t:" + i);
            alarms.answer(
                    new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, muted), Duration.ofHours(1)),
                    NOW);
        }
        silent().reconcile(NOW - HOUR, NOW + 1);
        assertThat(publisher.all()).isEmpty();
    }

    private SilenceAlarmReconciler silent() {
        var silence = new SilenceAlarmReconciler(HealthOptions.DEFAULT, alarms, key -> Optional.empty());
        for (int i = 0; i < 5; i++) {
            String id = "urn:t:" + i;
            silence.put(
                    id,
                    new SilenceAlarmReconciler.MonitoredDevice(
                            id,
                            "Thermometer",
                            FiwareScope.DEFAULT,
                            "urn:m",
                            true,
                            false,
                            NOW,
                            NOW - 60_000,
                            30_000,
                            null));
        }
        return silence;
    }

    private String farm() {
        return publisher.compacted(Topics.ALARMS).values().stream()
                .map(alarm -> new String(alarm, UTF_8))
                .filter(alarm -> alarm.contains("silent-farm"))
                .findFirst()
                .orElse("");
    }
}
