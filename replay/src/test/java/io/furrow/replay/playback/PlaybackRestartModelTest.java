package io.furrow.replay.playback;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.TreeMap;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Random programs of commands, of which pages know nothing: an answer comes after any number of commands, and a command twice. Now and
 * then the replay is restored from an older snapshot, or from none, to which only the newest command comes, on a machine whose clock is
 * another. Some are members of a group.
 */
class PlaybackRestartModelTest {
    private static final int SHORT = 20;
    private static final int LONG = 100;
    private static final int MAX_TURNS = 200;

    private List<StoredEvent> mission;
    private List<Wishes.Wish> wishes;
    private Random random;
    private Playback playback;
    private long now;
    private long run;
    private long skew;
    private final Deque<Fetched> answers = new ArrayDeque<>();
    private final Map<String, String> contents = new HashMap<>();
    private final TreeMap<Long, Long> stamps = new TreeMap<>();
    private final Map<Long, Epoch> epochs = new HashMap<>();
    private PlaybackState snapshot;
    private DesiredReplay desiredThen;

    static List<Long> some() {
        return new Random(20261125).longs(SHORT).boxed().toList();
    }

    static List<Long> many() {
        return new Random(20261126).longs(LONG).boxed().toList();
    }

    @ParameterizedTest(name = "seed {0}")
    @MethodSource("some")
    void givesNoEpochTwoContentsAndStepsNotBackInTime(long seed) {
        play(seed);
    }

    @Tag("full")
    @ParameterizedTest(name = "seed {0}")
    @MethodSource("many")
    void givesNoEpochTwoContentsWhateverComes(long seed) {
        play(seed);
    }

    private void play(long seed) {
        random = new Random(seed);
        mission = Missions.random(random);
        wishes = random.nextInt(4) == 0 ? Wishes.ofGroup(random, mission) : Wishes.random(random, mission);
        playback = new Playback(wishes.get(0).desired(), PlaybackState.fresh(), 0, this::wall);
        for (int next = 1; next < wishes.size(); next++) {
            for (int turn = random.nextInt(MAX_TURNS); turn > 0; turn--) {
                turn(wishes.get(next - 1).desired());
            }
            now = Math.max(now, wishes.get(next).at());
            note(playback.apply(wishes.get(next).desired(), now));
            assertThat(playback.apply(wishes.get(random.nextInt(next + 1)).desired(), now))
                    .as("an older command")
                    .isEmpty();
            assertThat(playback.desired()).isEqualTo(wishes.get(next).desired());
        }
        assertThat(playback.isOver()).isTrue();
        epochs.forEach(this::check);
    }

    private long wall(long clock) {
        return Wishes.wall(clock) + skew;
    }

    private void turn(DesiredReplay newest) {
        playback.fetch().ifPresent(fetch -> answers.add(answer(fetch)));
        switch (random.nextInt(8)) {
            case 0 -> now += random.nextInt(5_000);
            case 1, 2, 3 -> {
                if (!answers.isEmpty()) {
                    note(playback.take(answers.remove(), now));
                }
            }
            case 4 -> restartNowAndThen(newest);
            default -> note(playback.poll(now));
        }
    }

    private Fetched answer(Fetch fetch) {
        return fetch instanceof Fetch.Back back
                ? Missions.back(back, mission, playback.desired().plan().devices())
                : Missions.answer(fetch, mission, playback.desired(), random);
    }

    private void restartNowAndThen(DesiredReplay newest) {
        if (snapshot == null || random.nextInt(5) == 0) {
            snapshot = playback.snapshot(now);
            desiredThen = playback.desired();
        } else if (random.nextInt(5) == 0) {
            answers.clear();
            now += random.nextInt(60_000);
            boolean known = random.nextInt(4) > 0;
            skew = newest.clock() == null ? random.nextInt(1_000_000) - 500_000 : 0;
            run = known ? snapshot.stamp() : 0;
            playback = new Playback(
                    known ? desiredThen : newest, known ? snapshot : PlaybackState.fresh(), now, this::wall);
            if (!stamps.isEmpty()) {
                long newestStamp = stamps.values().stream().max(Long::compare).orElseThrow();
                playback.goOnAfter(stamps.lastKey(), newestStamp);
            }
            note(playback.apply(newest, now));
        }
    }

    /** An end may be said twice of an epoch, of which events came again. */
    private void note(Optional<Played> record) {
        record.ifPresent(played -> {
            Long before = stamps.lowerEntry(played.epoch()) == null
                    ? null
                    : stamps.headMap(played.epoch()).values().stream()
                            .max(Long::compare)
                            .orElseThrow();
            assertThat(played.stamp()).as("of one run").isGreaterThanOrEqualTo(run);
            run = played.stamp();
            assertThat(played.stamp())
                    .as("%s after epochs until %s", played, before)
                    .isGreaterThanOrEqualTo(before == null ? 0 : before);
            stamps.merge(played.epoch(), played.stamp(), Math::max);
            if (played.kind() != Played.Kind.END) {
                String content = played.kind() + " " + played.event().id() + " at " + played.time();
                String place = played.epoch() + " " + played.sequence();
                assertThat(contents.merge(place, content, (known, same) -> known))
                        .as("record %s", place)
                        .isEqualTo(content);
                long point = playback.snapshot(now).point();
                epochs.computeIfAbsent(played.epoch(), epoch -> new Epoch(point, new TreeMap<>()))
                        .records()
                        .put(played.sequence(), played);
                assertNotEarly(played);
            }
        });
    }

    /** Whatever the clock of a group has not shown yet. */
    private void assertNotEarly(Played played) {
        DesiredReplay desired = playback.desired();
        if (desired.clock() != null && !desired.loops() && played.kind() == Played.Kind.EVENT) {
            assertThat(played.time())
                    .as("the clock shows %s", desired.clock())
                    .isLessThanOrEqualTo(desired.position(wall(now)));
        }
    }

    /** Records of an epoch by their sequence, ends excepted. */
    private record Epoch(long point, TreeMap<Long, Played> records) {}

    /** What was known before its point, then the events from there, without a gap, as far as it was played. */
    private void check(long number, Epoch epoch) {
        List<String> devices = wishes.get(0).desired().plan().devices();
        List<StoredEvent> whole = new ArrayList<>(
                epoch.point() > mission.get(0).time() ? Missions.known(mission, epoch.point()) : List.of());
        mission.stream().filter(event -> event.time() >= epoch.point()).forEach(whole::add);
        whole.removeIf(event -> !devices.isEmpty() && !devices.contains(event.entityId()));
        assertThat(epoch.records().keySet()).last().isEqualTo(epoch.records().size() - 1L);
        assertThat(epoch.records().values().stream()
                        .map(played -> played.event().id())
                        .toList())
                .as("epoch %d", number)
                .isEqualTo(whole.stream()
                        .limit(epoch.records().size())
                        .map(StoredEvent::id)
                        .toList());
    }
}
