package io.furrow.control.alarm.action;

import java.io.IOException;
import java.time.Clock;
import java.time.Instant;
import java.time.ZoneOffset;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Executor;
import java.util.concurrent.RejectedExecutionException;

import org.junit.jupiter.api.Test;

import io.furrow.clock.SettableClock;
import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.control.audit.AuditEntry;
import io.furrow.control.device.CommandSender;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class StopRobotsTest {
    private static final long NOW = 1_700_000_000_000L;
    private static final FiwareScope FARM = new FiwareScope("farm", "/");

    private final List<String> sent = new ArrayList<>();
    private final List<AuditEntry> audited = new ArrayList<>();
    private final Map<String, String> types = new HashMap<>(Map.of("farm|/|r1", "ROBOT", "farm|/|cam", "Camera"));
    private int failing;
    private Executor executor = Runnable::run;
    private StopRobots robots = robots();

    @Test
    void stopsOnlyTheRobotsOfAPredictedEncounterOnce() {
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        robots.take(encounter("e-2", "started", "r1", "cam"), NOW);
        assertThat(sent).containsExactly("r1 ROBOT Stop");
        assertThat(audited).hasSize(1);
        assertThat(audited.get(0))
                .returns("alarms", AuditEntry::user)
                .returns("Stop", AuditEntry::command)
                .returns("sent", AuditEntry::result);
        assertThat(audited.get(0).about()).hasToString("{\"device\":\"r1\",\"encounter\":\"e-1\"}");
        robots.take(encounter("e-3", "predicted", "r1", "cam"), NOW);
        assertThat(sent).hasSize(2);
    }

    @Test
    void usesTheTypeOfTheRecordForAnAmbiguousId() {
        robots.take(
                new EncounterReport(
                        "e-1",
                        "predicted",
                        new EncounterReport.Member("cam", "m", "ROBOT", FARM),
                        new EncounterReport.Member("r1", "", "Camera", FARM),
                        12,
                        0.5),
                NOW);
        assertThat(sent).containsExactly("cam ROBOT Stop");
    }

    @Test
    void retriesAndAuditsTheResult() {
        failing = StopRobots.ATTEMPTS - 1;
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        assertThat(sent).hasSize(StopRobots.ATTEMPTS);
        failing = StopRobots.ATTEMPTS;
        robots.take(encounter("e-2", "predicted", "r1", "cam"), NOW);
        assertThat(audited).extracting(AuditEntry::result).containsExactly("sent", "error");
        assertThat(audited.get(1).reason()).isEqualTo("The context broker is away.");
        robots.take(encounter("e-2", "predicted", "r1", "cam"), NOW);
        assertThat(audited).extracting(AuditEntry::result).containsExactly("sent", "error", "sent");
    }

    @Test
    void auditsAStalePredictionOnce() {
        long old = NOW - StopRobots.FRESH.toMillis() - 1;
        robots.take(encounter("e-1", "predicted", "r1", "cam"), old);
        robots.take(encounter("e-1", "predicted", "r1", "cam"), old);
        assertThat(sent).isEmpty();
        assertThat(audited).extracting(AuditEntry::reason).containsExactly("the prediction was older than 10 s");
        robots.take(encounter("e-1", "predicted", "r1", "cam"), old + 1);
        assertThat(sent).hasSize(1);
    }

    @Test
    void sendsNoStopForAPredictionThatBecameStaleInTheQueue() {
        List<Runnable> waiting = new ArrayList<>();
        executor = waiting::add;
        SettableClock clock = new SettableClock(Instant.ofEpochMilli(NOW));
        robots = new StopRobots(settings(), types::get, audited::add, executor, clock);
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        clock.pass(StopRobots.FRESH.plusMillis(1));
        waiting.forEach(Runnable::run);
        assertThat(sent).isEmpty();
        assertThat(audited).extracting(AuditEntry::reason).containsExactly("the prediction was older than 10 s");
    }

    @Test
    void auditsAnUnknownTypeAndStopsOnceItIsKnown() {
        robots.take(encounter("e-1", "predicted", "r2", "cam"), NOW);
        robots.take(encounter("e-1", "predicted", "r2", "cam"), NOW);
        assertThat(sent).isEmpty();
        assertThat(audited).hasSize(1);
        assertThat(audited.get(0).result()).isEqualTo("error");
        types.put("farm|/|r2", "Robot");
        robots.take(encounter("e-1", "predicted", "r2", "cam"), NOW);
        assertThat(sent).containsExactly("r2 Robot Stop");
    }

    @Test
    void auditsAFullQueue() {
        executor = task -> {
            throw new RejectedExecutionException("full");
        };
        robots = robots();
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        assertThat(audited).extracting(AuditEntry::reason).containsExactly("too many robots are being stopped at once");
    }

    @Test
    void doesNotRepeatAStopOfAnotherInstance() throws Exception {
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        StopRobots other = robots();
        other.restore(NgsiJson.read(audited.get(0).toBytes()));
        other.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        assertThat(sent).hasSize(1);
        other.take(encounter("e-2", "predicted", "r1", "cam"), NOW);
        assertThat(sent).hasSize(2);
    }

    @Test
    void survivesUncheckedExceptionsOfTheSender() {
        robots = new StopRobots(
                StopRobots.Settings.of((device, type, command, value) -> {
                    throw new IllegalArgumentException("invalid URI");
                }),
                types::get,
                audited::add,
                executor,
                Clock.fixed(Instant.ofEpochMilli(NOW), ZoneOffset.UTC));
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        assertThat(audited)
                .singleElement()
                .satisfies(entry -> assertThat(entry.reason()).contains("invalid URI"));
    }

    /** Another tenant may have a robot of this id. */
    @Test
    void sendsTheStopToTheTenantOfTheEncounter() {
        robots = robots(StopRobots.Settings.of(new SenderOfTenants()));
        robots.take(encounter("e-1", "predicted", "r1", "cam"), NOW);
        assertThat(sent).containsExactly("farm|/|r1");
    }

    /** Both may have the same id. */
    @Test
    void stopsEachRobotInItsTenantOnce() throws Exception {
        byte[] record = Entity.builder("Analytics:Collision:1", "Analytics:Collision")
                .text("encounter", "e-1")
                .text("phase", "predicted")
                .text("Device1_ID", "r1")
                .text("Device1_type", "ROBOT")
                .text("Device2_ID", "r1")
                .text("Device2_service", "")
                .text("Device2_servicePath", "/north")
                .toBytes();
        types.put("|/north|r1", "Robot");
        robots = robots(StopRobots.Settings.of(new SenderOfTenants()));
        robots.take(EncounterReport.read(record, FARM), NOW);
        assertThat(sent).containsExactly("farm|/|r1", "|/north|r1");
        StopRobots other = robots(StopRobots.Settings.of(new SenderOfTenants()));
        other.restore(NgsiJson.read(audited.get(1).toBytes()));
        other.take(EncounterReport.read(record, FARM), NOW);
        assertThat(sent).containsExactly("farm|/|r1", "|/north|r1", "farm|/|r1");
    }

    /** Records the identities of the stopped devices. */
    private final class SenderOfTenants implements CommandSender {
        private FiwareScope tenant;

        @Override
        public void send(String device, String type, String command, String value) {
            sent.add(tenant.identity(device));
        }

        @Override
        public CommandSender in(FiwareScope scope) {
            tenant = scope;
            return this;
        }
    }

    private StopRobots robots() {
        return robots(settings());
    }

    private StopRobots robots(StopRobots.Settings settings) {
        return new StopRobots(
                settings, types::get, audited::add, executor, Clock.fixed(Instant.ofEpochMilli(NOW), ZoneOffset.UTC));
    }

    private StopRobots.Settings settings() {
        return StopRobots.Settings.of((device, type, command, value) -> {
            sent.add("%s %s %s".formatted(device, type, command));
            if (failing-- > 0) {
                throw new IOException("The context broker is away.");
            }
        });
    }

    private static EncounterReport encounter(String id, String phase, String first, String second) {
        return new EncounterReport(
                id,
                phase,
                new EncounterReport.Member(first, "m", "", FARM),
                new EncounterReport.Member(second, "", "", FARM),
                12,
                0.5);
    }
}
