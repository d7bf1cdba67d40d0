package io.furrow.analytics.presence;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.presence.Plot.Box;
import io.furrow.flink.record.TopicRecord;

import static io.furrow.analytics.presence.Story.fix;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class TrackPresenceTest {
    @AutoClose("stop")
    private Following following;

    private static final Logger LOG = LoggerFactory.getLogger(TrackPresenceTest.class);
    private static final PresenceRules AT_ONCE = new PresenceRules(Duration.ofSeconds(60), Duration.ZERO);
    private static final Plot FIELD = new Plot("f", 0, List.of(new Box(1, 1, 1 + 5e-4, 1 + 5e-4)), null);

    /** Random stories against the definition; the job stops and continues with 1, 2 and 4 subtasks in the middle of stays. */
    @Tag("full")
    @Test
    void tellsTheSameAsTheDefinitionHoweverOftenItRestarts() throws Exception {
        compareWithTheDefinition(100);
    }

    @Tag("full")
    @Test
    void tellsTheSameAsTheDefinitionOfManyStories() throws Exception {
        compareWithTheDefinition(Integer.getInteger("presence.cases", 300));
    }

    private static void compareWithTheDefinition(int cases) throws Exception {
        long seed = Long.getLong("presence.seed", System.nanoTime());
        LOG.info("{} stories of presence from seed {}", cases, seed);
        int compared = 0;
        for (int index = 0; index < cases; index++) {
            Story story = new Story(seed + index);
            List<String> expected = PresenceOracle.passages(story.fixes, story.plots, story.rules);
            assertThat(told(story, new Random(seed + index)))
                    .as("case %d of seed %d", index, seed)
                    .isEqualTo(expected);
            compared += expected.size();
        }
        assertThat(compared).isGreaterThan(cases);
    }

    private static List<String> told(Story story, Random random) throws Exception {
        int known = random.nextInt(story.plots.size() + 1);
        List<TopicRecord> records = new ArrayList<>();
        story.plots.forEach(plot -> records.add(plot.record(records.size())));
        Following following = new Following(story.rules, 1 << random.nextInt(3), records.subList(0, known));
        List<PresenceTransition> passages = new ArrayList<>();
        long newest = Long.MIN_VALUE;
        for (PositionFix fix : story.arrivals()) {
            following.receive(fix);
            newest = Math.max(newest, fix.time());
            if (random.nextInt(80) == 0) {
                following.restart(1 << random.nextInt(3));
            }
            if (random.nextInt(4) == 0) {
                long watermark = newest - Story.BOUND - 1;
                // A version may come at any time before the watermark reaches it.
                while (known < records.size()
                        && (story.plots.get(known).validFrom() <= watermark || random.nextInt(5) == 0)) {
                    following.receive(records.get(known++));
                }
                passages.addAll(following.advance(watermark));
            }
        }
        while (known < records.size()) {
            following.receive(records.get(known++));
        }
        passages.addAll(following.advance(Long.MAX_VALUE));
        assertThat(following.late()).isEmpty();
        assertThat(following.stateEntries()).isZero();
        assertThat(following.timers()).isZero();
        following.stop();
        return passages.stream().map(PresenceOracle::line).sorted().toList();
    }

    @Test
    void goesByOtherRulesAsSoonAsTheyAreRestored() throws Exception {
        following = new Following(
                new PresenceRules(Duration.ofSeconds(60), Duration.ofSeconds(10)), 1, List.of(FIELD.record(0)));
        following.receive(fix("d", 2, 2, 1000));
        assertThat(following.advance(5000)).isEmpty();

        following.restart(new PresenceRules(Duration.ofSeconds(20), Duration.ofSeconds(3)));

        assertThat(following.advance(60_000))
                .extracting(one -> one.phase().code() + " " + one.time() + " told " + one.emitted())
                .containsExactly("entered 1000 told 4000", "left 21000 told 24000");
        assertThat(following.stateEntries()).isZero();
    }

    @Test
    void tellsHowLongADeviceStayed() throws Exception {
        following = new Following(AT_ONCE, 1, List.of(FIELD.record(0)));
        following.receive(fix("d", 9, 9, 1000));
        following.receive(fix("d", 2, 2, 2000));
        following.receive(fix("d", 3, 3, 5000));
        following.receive(fix("d", 9, 9, 7500));

        List<PresenceTransition> passages = following.advance(8000);

        assertThat(passages)
                .extracting(one -> one.phase().code() + " " + one.time() + " "
                        + (one.time() - one.stay().since()))
                .containsExactly("entered 2000 0", "left 7500 5500");
    }

    @Test
    void judgesSilentDevicesAnewWhenTheirFieldChangesOrGoes() throws Exception {
        following = new Following(AT_ONCE, 1, List.of(FIELD.record(0)));
        following.receive(fix("stays", 1, 1, 1000));
        following.receive(fix("falls-out", 4, 4, 1000));
        following.receive(fix("comes-in", 7, 1, 1000));
        assertThat(following.advance(1000)).hasSize(2);

        following.receive(new Plot("f", 3000, List.of(new Box(1, 1, 1 + 8e-4, 1 + 2e-4)), null).record(1));
        following.receive(new Plot("f", 20_000, List.of(), null).record(2));

        assertThat(following.advance(2999)).isEmpty();
        assertThat(following.advance(3000 + TrackPresence.AGAIN).stream().map(PresenceOracle::line))
                .containsExactlyInAnyOrder(
                        "data.raw|farm|/|falls-out f left at 3000 told 3000 from 1.0004,1.0004 field-changed since"
                                + " 1000",
                        "data.raw|farm|/|comes-in f entered at 3000 told 3000 from 1.0007,1.0001 field-changed since"
                                + " 3000");
        assertThat(following.advance(20_000))
                .extracting(
                        one -> one.stay().fix().id() + " " + one.stay().cause().code() + " " + one.time())
                .containsExactlyInAnyOrder("stays field-removed 20000", "comes-in field-removed 20000");
    }

    @Test
    void takesAVersionThatComesLateIntoAccountSoon() throws Exception {
        following = new Following(AT_ONCE, 1, List.of(FIELD.record(0)));
        following.receive(fix("d", 2, 2, 10_000));
        following.receive(fix("d", 3, 3, 11_500));
        assertThat(following.advance(12_000)).hasSize(1);

        following.receive(new Plot("f", 11_000, List.of(), null).record(1));

        assertThat(following.advance(12_000 + TrackPresence.AGAIN))
                .singleElement()
                .satisfies(left -> {
                    assertThat(left.stay().cause()).isEqualTo(Cause.FIELD_REMOVED);
                    assertThat(left.time()).isBetween(12_000L, 12_000 + TrackPresence.AGAIN);
                });
    }

    @Test
    void passesOverFlickerAtTheBorder() throws Exception {
        following = new Following(
                new PresenceRules(Duration.ofSeconds(60), Duration.ofSeconds(3)), 1, List.of(FIELD.record(0)));
        int[] where = {2, 9, 2, 2, 2, 2, 9, 2, 9, 2, 9, 9, 9, 9};
        for (int second = 0; second < where.length; second++) {
            following.receive(fix("d", where[second], 2, 1000L * second));
        }

        assertThat(following.advance(20_000).stream().map(PresenceOracle::line))
                .containsExactly(
                        "data.raw|farm|/|d f entered at 2000 told 5000 from 1.0002,1.0002 moved since 2000",
                        "data.raw|farm|/|d f left at 10000 told 13000 from 1.0009,1.0002 moved since 2000");
    }

    @Test
    void showsTheLatePositionsThatAreTheNewestOfTheirDevice() throws Exception {
        following = new Following(AT_ONCE, 1, List.of(FIELD.record(0)));
        following.receive(fix("d", 2, 2, 10_000));
        following.receive(fix("e", 2, 2, 13_000));
        following.advance(12_000);

        following.receive(fix("d", 9, 9, 9_000));
        following.receive(fix("d", 9, 9, 11_000));
        following.receive(fix("e", 9, 9, 11_000));
        following.receive(fix("f", 9, 9, 11_500));

        assertThat(following.late()).hasSize(4);
        assertThat(following.lagging())
                .extracting(LaggingPosition::id, LaggingPosition::reached, LaggingPosition::counted)
                .containsExactly(tuple("d", 12_000L, 10_000L), tuple("f", 12_000L, Long.MIN_VALUE));
    }

    @Test
    void setsAsideWhatComesBehindTheWatermarkAlsoAfterARestart() throws Exception {
        following = new Following(AT_ONCE, 2, List.of(FIELD.record(0)));
        following.receive(fix("d", 2, 2, 10_000));
        following.receive(fix("e", 2, 2, 10_000));
        assertThat(following.advance(12_000)).hasSize(2);

        following.receive(fix("d", 9, 9, 12_000));
        following.restart(1);
        following.receive(fix("d", 9, 9, 11_000));

        assertThat(following.late()).extracting(PositionFix::time).containsExactlyInAnyOrder(12_000L, 11_000L);
    }

    @Test
    void takesWhatWasOnItsWayToASubtaskThatWasBehind() throws Exception {
        following = new Following(AT_ONCE, 2, List.of(FIELD.record(0)));
        PositionFix ahead = fix("d", 9, 9, 11_000);
        PositionFix behind = null;
        for (int i = 0; behind == null || following.subtaskOf(behind) == following.subtaskOf(ahead); i++) {
            behind = fix("e" + i, 2, 2, 11_000);
        }
        following.advance(following.subtaskOf(ahead), 12_000);
        following.advance(following.subtaskOf(behind), 10_000);

        following.restart(1);
        following.receive(ahead);
        following.receive(behind);

        assertThat(following.late()).containsExactly(ahead);
        assertThat(following.advance(12_000)).hasSize(1);
    }

    @Test
    void keepsOneTimerPerDevice() throws Exception {
        following = new Following(AT_ONCE, 1, List.of(FIELD.record(0)));
        for (int step = 0; step < 50; step++) {
            following.receive(fix("d", step % 12, 2, 1000 + step));
            following.receive(fix("e", step % 12, 2, 1000 + step));
        }
        assertThat(following.timers()).isEqualTo(2);
        assertThat(following.advance(1020)).isNotEmpty();
        assertThat(following.timers()).isEqualTo(2);
    }
}
