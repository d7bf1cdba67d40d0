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
 * Runs random commands, some twice, with results of reads that arrive after any number of commands. The replay is
 * restored at random times from an older snapshot, or from none, on a machine with another clock; a replay without a
 * snapshot gets only the newest command. Some replays are members of a group.
 */
class PlaybackRestartModelTest {
    private static final int SHORT = 20;
    private static final int LONG = 100;
    private static final int MAX_TURNS = 200;

    private List<StoredEvent> mission;
    private List<DesiredStates.DesiredState> desiredStates;
    private Random random;
    private Playback playback;
    private long now;
    private long run;
    private long skew;
    private final Deque<ReadResult> answers = new ArrayDeque<>();
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
    void givesNoEpochTwoContentsAndNeverStepsBackInTime(long seed) {
        play(seed);
    }

    @Tag("full")
    @ParameterizedTest(name = "seed {0}")
    @MethodSource("many")
    void givesNoEpochTwoContentsInManyRuns(long seed) {
        play(seed);
    }

    private void play(long seed) {
        random = new Random(seed);
        mission = Missions.random(random);
        desiredStates =
                random.nextInt(4) == 0 ? DesiredStates.ofGroup(random, mission) : DesiredStates.random(random, mission);
        playback = new Playback(desiredStates.get(0).desired(), new PlaybackState(), 0, this::wall);
        for (int next = 1; next < desiredStates.size(); next++) {
            for (int turn = random.nextInt(MAX_TURNS); turn > 0; turn--) {
                turn(desiredStates.get(next - 1).desired());
            }
            now = Math.max(now, desiredStates.get(next).at());
            check(playback.apply(desiredStates.get(next).desired(), now));
            assertThat(playback.apply(
                            desiredStates.get(random.nextInt(next + 1)).desired(), now))
                    .as("an older command")
                    .isEmpty();
            assertThat(playback.desired()).isEqualTo(desiredStates.get(next).desired());
        }
        assertThat(playback.isOver()).isTrue();
        epochs.forEach(this::check);
    }

    private long wall(long clock) {
        return DesiredStates.wall(clock) + skew;
    }

    private void turn(DesiredReplay newest) {
        playback.fetch().ifPresent(readRequest -> answers.add(answer(readRequest)));
        switch (random.nextInt(8)) {
            case 0 -> now += random.nextInt(5_000);
            case 1, 2, 3 -> {
                if (!answers.isEmpty()) {
                    check(playback.accept(answers.remove(), now));
                }
            }
            case 4 -> restartNowAndThen(newest);
            default -> check(playback.poll(now));
        }
    }

    private ReadResult answer(ReadRequest readRequest) {
        return readRequest instanceof ReadRequest.Back back
                ? Missions.back(back, mission, playback.desired().plan().devices())
                : Missions.answer(readRequest, mission, playback.desired(), random);
    }

    private void restartNowAndThen(DesiredReplay newest) {
        if (snapshot == null || random.nextInt(5) == 0) {
            snapshot = playback.snapshot(now);
            desiredThen = playback.desired();
        } else if (random.nextInt(5) == 0) {
            answers.clear();
            now += random.nextInt(60_000);
            boolean restored = random.nextInt(4) > 0;
            skew = newest.clock() == null ? random.nextInt(1_000_000) - 500_000 : 0;
            run = restored ? snapshot.stamp() : 0;
            playback = new Playback(
                    restored ? desiredThen : newest, restored ? snapshot : new PlaybackState(), now, this::wall);
            if (!stamps.isEmpty()) {
                long newestStamp = stamps.values().stream().max(Long::compare).orElseThrow();
                playback.resumeAfter(stamps.lastKey(), newestStamp);
            }
            check(playback.apply(newest, now));
        }
    }

    /** Checks a record against earlier ones. An epoch may end twice, because a restart may repeat events. */
    private void check(Optional<PlaybackRecord> record) {
        record.ifPresent(playbackRecord -> {
            Long before = stamps.lowerEntry(playbackRecord.epoch()) == null
                    ? null
                    : stamps.headMap(playbackRecord.epoch()).values().stream()
                            .max(Long::compare)
                            .orElseThrow();
            assertThat(playbackRecord.stamp()).as("of one run").isGreaterThanOrEqualTo(run);
            run = playbackRecord.stamp();
            assertThat(playbackRecord.stamp())
                    .as("%s after epochs until %s", playbackRecord, before)
                    .isGreaterThanOrEqualTo(before == null ? 0 : before);
            stamps.merge(playbackRecord.epoch(), playbackRecord.stamp(), Math::max);
            if (playbackRecord.kind() != PlaybackRecord.Kind.END) {
                String content =
                        playbackRecord.kind() + " " + playbackRecord.event().id() + " at " + playbackRecord.time();
                String place = playbackRecord.epoch() + " " + playbackRecord.sequence();
                assertThat(contents.merge(place, content, (first, second) -> first))
                        .as("record %s", place)
                        .isEqualTo(content);
                long point = playback.snapshot(now).point;
                epochs.computeIfAbsent(playbackRecord.epoch(), epoch -> new Epoch(point, new TreeMap<>()))
                        .records()
                        .put(playbackRecord.sequence(), playbackRecord);
                assertNotEarly(playbackRecord);
            }
        });
    }

    /** Checks that an event is not played before the group's clock reaches it. */
    private void assertNotEarly(PlaybackRecord playbackRecord) {
        DesiredReplay desired = playback.desired();
        if (desired.clock() != null && !desired.loops() && playbackRecord.kind() == PlaybackRecord.Kind.EVENT) {
            assertThat(playbackRecord.time())
                    .as("the clock shows %s", desired.clock())
                    .isLessThanOrEqualTo(desired.position(wall(now)));
        }
    }

    /** The records of an epoch by their sequence, without ends. */
    private record Epoch(long point, TreeMap<Long, PlaybackRecord> records) {}

    /** Checks that an epoch has the states before its point, then the events from there without a gap. */
    private void check(long number, Epoch epoch) {
        List<String> devices = desiredStates.get(0).desired().plan().devices();
        List<StoredEvent> whole = new ArrayList<>(
                epoch.point() > mission.get(0).time() ? Missions.stateBefore(mission, epoch.point()) : List.of());
        mission.stream().filter(event -> event.time() >= epoch.point()).forEach(whole::add);
        whole.removeIf(event -> !devices.isEmpty() && !devices.contains(event.entityId()));
        assertThat(epoch.records().keySet()).last().isEqualTo(epoch.records().size() - 1L);
        assertThat(epoch.records().values().stream()
                        .map(playbackRecord -> playbackRecord.event().id())
                        .toList())
                .as("epoch %d", number)
                .isEqualTo(whole.stream()
                        .limit(epoch.records().size())
                        .map(StoredEvent::id)
                        .toList());
    }
}
