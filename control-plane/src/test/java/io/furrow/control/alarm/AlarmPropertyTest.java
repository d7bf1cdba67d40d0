package io.furrow.control.alarm;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInfo;
import org.junit.jupiter.api.TestReporter;

import io.furrow.control.manager.KeptOutbox;
import io.furrow.control.manager.MapRecords;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StateJson;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.RefusedException;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Random causes, ends, commands and passing time; after each step the alarms are sound. */
class AlarmPropertyTest {
    private static final int FARMS = 60;
    private static final int STEPS = 200;

    @Test
    void isSoundWhateverHappensAndIsAsked(TestInfo test, TestReporter reporter) {
        long seed = System.nanoTime();
        reporter.publishEntry(test.getDisplayName(), "seed " + seed);
        int refused = 0;
        int closed = 0;
        for (int i = 0; i < FARMS; i++) {
            Walk walk = new Walk(new Random(seed + i), "seed " + (seed + i));
            walk.run();
            refused += walk.refused;
            closed += walk.closed.size();
        }
        assertThat(refused).isBetween(FARMS, FARMS * STEPS);
        assertThat(closed).isGreaterThan(FARMS);
    }

    private static final class Walk {
        private final MapRecords<Alarm> alarms = MapRecords.of(Alarm.class);
        private final MapRecords<String> current = MapRecords.of(String.class);
        private final MapRecords<AlarmRecords.Mute> mutes = MapRecords.of(AlarmRecords.Mute.class);
        private final KeptOutbox outbox = new KeptOutbox();
        private final AlarmDesk desk = new AlarmDesk(
                new AlarmRecords(alarms, current, mutes), new Sequence(MapRecords.of(Long.class)), outbox);
        private final Set<String> closed = new HashSet<>();
        private final Map<String, AlarmState> before = new HashMap<>();
        private final Random random;
        private final String said;
        private long now = 1_000_000;
        private int refused;

        Walk(Random random, String said) {
            this.random = random;
            this.said = said;
        }

        void run() {
            for (int i = 0; i < STEPS; i++) {
                before.clear();
                alarms.forEach(alarm -> before.put(alarm.alarm(), alarm.state()));
                step();
                checkLives();
                checkOneEach();
                checkTopic();
            }
            now += Duration.ofDays(2).toMillis();
            desk.passTime(now);
            assertThat(mutes.all()).as(said).isEmpty();
            assertThat(alarms.all()).as(said).allMatch(alarm -> alarm.changed() == now || alarm.until() == null);
        }

        private void step() {
            switch (random.nextInt(6)) {
                case 0, 1 -> desk.raise(cause(), now);
                case 2 -> desk.end(kind(), subject(), "it is over", now);
                case 3 -> {
                    now += random.nextInt(60_000);
                    desk.passTime(now);
                }
                default -> ask();
            }
        }

        private void ask() {
            int written = outbox.all().size();
            String content = content();
            try {
                desk.answer(command(), now);
            } catch (RefusedException e) {
                refused++;
                assertThat(content()).as(said).isEqualTo(content);
                assertThat(outbox.all()).as(said).hasSize(written);
            }
        }

        private AlarmCommand command() {
            String alarm = "%s-%d".formatted(kind().code(), 1 + random.nextInt(40));
            AlarmCommand.Target target = switch (random.nextInt(3)) {
                case 0 -> new AlarmCommand.OfAlarm(alarm);
                case 1 -> new AlarmCommand.OfKind(kind(), null);
                default -> new AlarmCommand.OfKind(kind(), subject());
            };
            return switch (random.nextInt(4)) {
                case 0 -> new AlarmCommand.Acknowledge(alarm, "ann");
                case 1 -> new AlarmCommand.Close(alarm, null);
                case 2 -> new AlarmCommand.Mute(target, Duration.ofSeconds(1 + random.nextInt(100)));
                default -> new AlarmCommand.Unmute(target);
            };
        }

        private Cause cause() {
            Duration holds = random.nextBoolean() ? null : Duration.ofSeconds(1 + random.nextInt(60));
            return new Cause(kind(), subject(), "look", List.of(new Cause.Device("x", null)), holds);
        }

        private AlarmKind kind() {
            return AlarmKind.values()[random.nextInt(AlarmKind.values().length)];
        }

        private String subject() {
            return "s" + random.nextInt(3);
        }

        /** No alarm goes back, and none vanishes within a day. */
        private void checkLives() {
            before.forEach((id, state) -> {
                AlarmState after = alarms.get(id).state();
                assertThat(after == state || state.canBecome(after)).as(said).isTrue();
            });
            alarms.forEach(alarm -> {
                assertThat(alarm.reason() != null).as(said).isEqualTo(alarm.state() == AlarmState.CLOSED);
                if (alarm.state() == AlarmState.CLOSED) {
                    closed.add(alarm.alarm());
                }
            });
        }

        private void checkOneEach() {
            Set<String> keys = new HashSet<>();
            alarms.forEach(alarm -> {
                if (alarm.state() != AlarmState.CLOSED) {
                    assertThat(keys.add(alarm.key())).as(said).isTrue();
                    assertThat(current.get(alarm.key())).as(said).isEqualTo(alarm.alarm());
                }
            });
            assertThat(current.all()).as(said).hasSameSizeAs(keys);
        }

        /** It shows each alarm as it is, but for how often it was seen since its last change. */
        private void checkTopic() {
            Map<String, byte[]> shown = outbox.compacted(Topics.ALARMS);
            assertThat(shown).as(said).hasSameSizeAs(alarms.all());
            Set<Long> sequences = new HashSet<>();
            shown.forEach((id, json) -> {
                Alarm alarm = StateJson.read(json, Alarm.class);
                Alarm known = alarms.get(id);
                assertThat(alarm.state()).as(said).isEqualTo(known.state());
                assertThat(alarm.mutedUntil()).as(said).isEqualTo(known.mutedUntil());
                assertThat(alarm.count()).as(said).isLessThanOrEqualTo(known.count());
                assertThat(sequences.add(alarm.sequence())).as(said).isTrue();
            });
        }

        private String content() {
            return alarms.content() + current.content() + mutes.content();
        }
    }
}
