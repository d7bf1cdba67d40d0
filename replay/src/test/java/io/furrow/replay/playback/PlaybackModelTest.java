package io.furrow.replay.playback;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.event.HeaderNames;
import io.furrow.replay.record.ReplayRecords;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Compares playbacks with {@link SimpleReplay}. */
class PlaybackModelTest {
    private static final int MISSIONS = 100;
    private static final int RUNS_EACH = 5;

    static List<Long> seeds() {
        return new Random(20261123).longs(MISSIONS).boxed().toList();
    }

    @Tag("full")
    @ParameterizedTest(name = "seed {0}")
    @MethodSource("seeds")
    void writesTheRecordsOfTheModelAtItsTimes(long seed) {
        Random random = new Random(seed);
        List<StoredEvent> mission = Missions.random(random);
        for (int run = 0; run < RUNS_EACH; run++) {
            List<DesiredStates.DesiredState> desiredStates = DesiredStates.random(random, mission);

            assertThat(played(mission, desiredStates, random)).isEqualTo(SimpleReplay.lines(mission, desiredStates));
        }
    }

    /** Checks that the comparison is not empty. */
    @Test
    void coversAllKindsOfRecords() {
        List<String> all = new ArrayList<>();
        for (long seed : seeds()) {
            Random random = new Random(seed);
            List<StoredEvent> mission = Missions.random(random);
            all.addAll(SimpleReplay.lines(mission, DesiredStates.random(random, mission)));
        }

        for (String kind :
                List.of("event", "prime", "end stopped", "end seek", "end loop", "end ended", "end step", "epoch 4")) {
            assertThat(all).as(kind).filteredOn(line -> line.contains(kind)).hasSizeGreaterThan(20);
        }
    }

    @ParameterizedTest(name = "seed {0}")
    @MethodSource("seeds")
    void continuesWithTheNextRecordAfterARestart(long seed) {
        Random random = new Random(seed);
        List<StoredEvent> mission = Missions.random(random);
        DesiredReplay desired = DesiredStates.with(
                DesiredStates.start(random.nextBoolean() ? 1000 : ReplayCommand.MAX),
                State.RUNNING,
                1000,
                Missions.TIME + random.nextInt(20_000),
                0);
        List<String> whole = untimed(played(mission, List.of(new DesiredStates.DesiredState(0, desired)), random));

        List<String> lines = new ArrayList<>();
        Playback playback = new Playback(desired, new PlaybackState(), 0, DesiredStates::wall);
        for (long now = 0; !playback.isOver(); now++) {
            read(playback, mission, random, now, lines);
            Optional<PlaybackRecord> played = playback.poll(now);
            played.ifPresent(one -> lines.add(line(0, one, desired)));
            if (random.nextInt(10) == 0) {
                playback = new Playback(desired, playback.snapshot(now), now + 5, DesiredStates::wall);
            }
        }

        assertThat(untimed(lines)).isEqualTo(whole);
    }

    private static List<String> untimed(List<String> lines) {
        return lines.stream().map(line -> line.substring(line.indexOf(' '))).toList();
    }

    private static List<String> played(
            List<StoredEvent> mission, List<DesiredStates.DesiredState> desiredStates, Random random) {
        List<String> lines = new ArrayList<>();
        Playback playback = new Playback(desiredStates.get(0).desired(), new PlaybackState(), 0, DesiredStates::wall);
        int next = 1;
        long now = 0;
        while (now != Long.MAX_VALUE) {
            boolean read = read(playback, mission, random, now, lines);
            Optional<PlaybackRecord> played = playback.poll(now);
            if (played.isPresent()) {
                lines.add(line(now, played.get(), playback.desired()));
            } else if (!read
                    && !read(playback, mission, random, now, lines)
                    && (playback.due() > now || playback.isOver())) {
                long due = Math.max(playback.due(), now);
                if (next < desiredStates.size()
                        && desiredStates.get(next).at() <= due
                        && desiredStates.get(next).at() <= now) {
                    long at = now;
                    Playback running = playback;
                    running.apply(desiredStates.get(next).desired(), at)
                            .ifPresent(end -> lines.add(line(at, end, running.desired())));
                    next++;
                } else {
                    now = next < desiredStates.size()
                            ? Math.min(desiredStates.get(next).at(), due)
                            : due;
                }
            }
        }
        return lines;
    }

    /**
     * Answers the playback's requests.
     *
     * @return whether there was one
     */
    private static boolean read(
            Playback playback, List<StoredEvent> mission, Random random, long now, List<String> lines) {
        boolean any = false;
        for (Optional<ReadRequest> fetch = playback.fetch(); fetch.isPresent(); fetch = playback.fetch()) {
            ReadResult answer = fetch.get() instanceof ReadRequest.Back back
                    ? Missions.back(back, mission, playback.desired().plan().devices())
                    : Missions.answer(fetch.get(), mission, playback.desired(), random);
            playback.accept(answer, now).ifPresent(end -> lines.add(line(now, end, playback.desired())));
            any = true;
        }
        return any;
    }

    private static String line(long now, PlaybackRecord playbackRecord, DesiredReplay desired) {
        TopicRecord record = ReplayRecords.of(playbackRecord, desired);
        Map<String, String> headers = record.headers();
        String reason = playbackRecord.reason() == null ? "" : " " + playbackRecord.reason();
        return String.join(
                " ",
                Long.toString(now),
                Long.toString(record.timestamp()),
                new String(record.key(), UTF_8),
                headers.get(HeaderNames.REPLAY_KIND) + reason,
                "epoch " + headers.get(HeaderNames.REPLAY_EPOCH),
                "sequence " + headers.get(HeaderNames.REPLAY_SEQUENCE),
                "offset " + headers.get(HeaderNames.REPLAY_OFFSET),
                headers.get(HeaderNames.REPLAY_TIME),
                headers.get(HeaderNames.REPLAY_CE_ID),
                headers.get(HeaderNames.CE_ID));
    }
}
