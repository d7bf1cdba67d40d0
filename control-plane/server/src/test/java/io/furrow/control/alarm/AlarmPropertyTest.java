package io.furrow.control.alarm;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInfo;
import org.junit.jupiter.api.TestReporter;

import io.furrow.control.manager.CapturingPublisher;
import io.furrow.control.manager.MapTable;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.RejectedException;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Applies random causes, ends, commands and passing time; after each step the alarms are consistent. */
@Tag("full")
class AlarmPropertyTest {
    private static final int FARMS = 20;
    private static final int STEPS = 200;

    @Test
    void staysConsistentUnderRandomEvents(TestInfo test, TestReporter reporter) {
        long seed = System.nanoTime();
        reporter.publishEntry(test.getDisplayName(), "seed " + seed);
        int rejected = 0;
        int closed = 0;
        int crowded = 0;
        for (int i = 0; i < FARMS; i++) {
            Walk walk = new Walk(new Random(seed + i), "seed " + (seed + i));
            walk.run();
            rejected += walk.rejected;
            closed += walk.closed.size();
            crowded += walk.crowded;
        }
        assertThat(crowded).as("causes without an alarm").isGreaterThan(FARMS);
        assertThat(rejected).isBetween(FARMS, FARMS * STEPS);
        assertThat(closed).isGreaterThan(FARMS);
    }

    private static final class Walk {
        private final MapTable<Alarm> alarms = MapTable.of(Alarm.class);
        private final MapTable<String> current = MapTable.of(String.class);
        private final MapTable<AlarmTables.Mute> mutes = MapTable.of(AlarmTables.Mute.class);
        private final CapturingPublisher publisher = new CapturingPublisher();
        private final MapTable<AlarmLimit.Group> groups = MapTable.of(AlarmLimit.Group.class);
        private final MapTable<AlarmLimit.Overflow> overflows = MapTable.of(AlarmLimit.Overflow.class);
        private final AlarmCommandHandler handler = new AlarmCommandHandler(
                new AlarmTables(alarms, current, mutes, groups, overflows),
                new Sequence(MapTable.of(Long.class)),
                publisher);
        private final Map<String, Long> validUntil = new HashMap<>();
        private final Set<String> closed = new HashSet<>();
        private final Map<String, AlarmState> before = new HashMap<>();
        private final Random random;
        private final String label;
        private long now = 1_000_000;
        private int rejected;
        private int crowded;

        Walk(Random random, String label) {
            this.random = random;
            this.label = label;
        }

        void run() {
            for (int i = 0; i < STEPS; i++) {
                before.clear();
                alarms.forEach(alarm -> before.put(alarm.alarm(), alarm.state()));
                step();
                checkLives();
                checkOneEach();
                checkTopic();
                checkLimits();
            }
            now += Duration.ofDays(2).toMillis();
            handler.passTime(now);
            assertThat(mutes.all()).as(label).isEmpty();
            assertThat(overflows.all()).as(label).allMatch(each -> each.until() == null);
            assertThat(alarms.all())
                    .as(label)
                    .allMatch(alarm ->
                            alarm.period().changed() == now || alarm.period().until() == null);
        }

        private void step() {
            switch (random.nextInt(6)) {
                case 0 -> raise(kind(), 1);
                case 1 -> raise(kind(), random.nextInt(2 * AlarmLimit.MAX_ALARMS));
                case 2 -> {
                    AlarmKind kind = kind();
                    String subject = subject();
                    validUntil.remove(Cause.key(kind, subject));
                    handler.end(kind, subject, "it is over", now);
                }
                case 3 -> {
                    now += random.nextInt(60_000);
                    handler.passTime(now);
                }
                default -> request();
            }
        }

        private void raise(AlarmKind kind, int number) {
            for (int i = 0; i < number; i++) {
                Cause cause = cause(kind);
                validUntil.put(cause.key(), cause.validity() == null ? Long.MAX_VALUE : cause.until(now));
                handler.raise(cause, now);
            }
            crowded += overflows.all().size();
        }

        private void request() {
            int written = publisher.all().size();
            String content = content();
            try {
                handler.answer(command(), now);
            } catch (RejectedException e) {
                rejected++;
                assertThat(content()).as(label).isEqualTo(content);
                assertThat(publisher.all()).as(label).hasSize(written);
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

        private Cause cause(AlarmKind kind) {
            Duration validity = random.nextBoolean() ? null : Duration.ofSeconds(1 + random.nextInt(60));
            Cause cause = new Cause(
                    kind, subject(), "look", List.of(new Cause.AffectedDevice("x", null, null, null)), validity);
            return AlarmLimit.KINDS.contains(kind) ? cause.inGroup("g") : cause;
        }

        private AlarmKind kind() {
            return AlarmKind.values()[random.nextInt(AlarmKind.values().length)];
        }

        private String subject() {
            return "s" + random.nextInt(2 * AlarmLimit.MAX_ALARMS);
        }

        /** Alarms only proceed in their life cycle, and none is removed within a day. */
        private void checkLives() {
            before.forEach((id, state) -> {
                AlarmState after = alarms.get(id).state();
                assertThat(after == state || state.canBecome(after)).as(label).isTrue();
            });
            alarms.forEach(alarm -> {
                assertThat(alarm.handling().reason() != null).as(label).isEqualTo(alarm.state() == AlarmState.CLOSED);
                if (alarm.state() == AlarmState.CLOSED) {
                    closed.add(alarm.alarm());
                }
            });
        }

        private void checkOneEach() {
            Set<String> keys = new HashSet<>();
            alarms.forEach(alarm -> {
                if (alarm.state() != AlarmState.CLOSED) {
                    assertThat(keys.add(alarm.key())).as(label).isTrue();
                    assertThat(current.get(alarm.key())).as(label).isEqualTo(alarm.alarm());
                }
            });
            assertThat(current.all()).as(label).hasSameSizeAs(keys);
        }

        /** The topic contains each alarm, except observations since its last change. */
        private void checkTopic() {
            Map<String, byte[]> shown = publisher.compacted(Topics.ALARMS);
            assertThat(shown).as(label).hasSameSizeAs(alarms.all());
            Set<Long> sequences = new HashSet<>();
            shown.forEach((id, json) -> {
                Alarm alarm = StateJson.read(json, Alarm.class);
                Alarm existing = alarms.get(id);
                assertThat(alarm.state()).as(label).isEqualTo(existing.state());
                assertThat(alarm.handling().mutedUntil())
                        .as(label)
                        .isEqualTo(existing.handling().mutedUntil());
                assertThat(alarm.period().count())
                        .as(label)
                        .isLessThanOrEqualTo(existing.period().count());
                assertThat(sequences.add(alarm.sequence())).as(label).isTrue();
            });
        }

        /** An active cause has an alarm or is counted, unless a user closed its alarm; and the counts are correct. */
        private void checkLimits() {
            Map<String, Integer> open = new HashMap<>();
            Map<String, Integer> counts = new HashMap<>();
            alarms.forEach(alarm -> {
                if (alarm.state() != AlarmState.CLOSED && alarm.group() != null && !alarm.isOfGroup()) {
                    open.merge(Cause.key(alarm.kind(), alarm.group()), 1, Integer::sum);
                }
            });
            overflows.forEach(each -> counts.merge(Cause.key(each.kind(), each.group()), 1, Integer::sum));
            groups.forEach(group -> {
                assertThat(group.alarms()).as(label).isEqualTo(open.getOrDefault(group.key(), 0));
                assertThat(group.counted()).as(label).isEqualTo(counts.getOrDefault(group.key(), 0));
            });
            assertThat(open.values()).as(label).allMatch(number -> number <= AlarmLimit.MAX_ALARMS);
            Set<String> closedBefore = new HashSet<>();
            alarms.forEach(alarm -> {
                if (alarm.state() == AlarmState.CLOSED) {
                    closedBefore.add(alarm.key());
                }
            });
            validUntil.forEach((key, until) -> {
                boolean existing = current.get(key) != null || overflows.get(key) != null;
                assertThat(existing || closedBefore.contains(key) || until <= now)
                        .as(label + key)
                        .isTrue();
            });
        }

        private String content() {
            return alarms.content() + current.content() + mutes.content() + groups.content() + overflows.content();
        }
    }
}
