package io.furrow.control.replay;

import java.time.Instant;
import java.util.List;
import java.util.function.Function;
import java.util.stream.LongStream;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.RejectedException;
import io.furrow.model.topic.TopicName;

/**
 * The missions that are stored, as {@code service.recordings} lists them.
 *
 * @param checked whether that list is kept; else any mission may be stored
 * @param find by mission; null if none is listed
 */
record RecordedMissions(boolean checked, Function<String, RecordedMission> find) {
    /** @throws RejectedException where one of the missions is not stored, as far as that is known */
    void require(List<String> missions) throws RejectedException {
        List<String> unknown =
                missions.stream().filter(each -> lookup(each) == null).toList();
        if (checked && !unknown.isEmpty()) {
            throw new RejectedException(
                    ErrorCode.UNKNOWN_MISSION,
                    "nothing is stored of mission '%s'; './furrow replay missions' and GET /api/recordings list what is"
                            .formatted(String.join("', '", unknown)));
        }
    }

    /** Listed by what stands for it in topics, which of nearly every mission is its name. */
    private RecordedMission lookup(String mission) {
        RecordedMission listed = find.apply(mission);
        return listed == null ? find.apply(TopicName.of(mission)) : listed;
    }

    /**
     * Refuses a time that a replay does not play: outside of its recording, as far as that is known, or of what is requested of it. A mission
     * that runs is longer than the list of recordings says; until the replay reports how long, any later time is in it.
     *
     * @param time of an event, epoch ms
     * @param reported null if nothing was reported of the replay
     */
    void requireWithin(long time, DesiredReplay replay, ReportedReplay reported) throws RejectedException {
        RecordedMission listed = replay.plan().source() == null ? lookup(replay.mission()) : null;
        boolean isReported = reported != null && reported.first() != null;
        LongStream.Builder firsts = LongStream.builder();
        if (listed != null) {
            firsts.add(listed.first());
        }
        if (isReported) {
            firsts.add(reported.first());
        }
        long begin = replay.from(firsts.build().min().orElse(0));
        long last = !isReported
                ? Long.MAX_VALUE
                : listed == null ? reported.last() : Math.max(listed.last(), reported.last());
        long end = Math.min(last, replay.to() - 1);
        if (time < begin || time > end) {
            throw new RejectedException(
                    ErrorCode.WRONG_MEMBER,
                    time < begin
                            ? "'to' must be at least %s, where replay '%s' begins; choose that or a later time"
                                    .formatted(Instant.ofEpochMilli(begin), replay.replay())
                            : "'to' must be at most %s, where replay '%s' ends; choose that or an earlier time"
                                    .formatted(Instant.ofEpochMilli(end), replay.replay()));
        }
    }

    /**
     * From the first event of the missions to after their last.
     *
     * @return null if nothing is known of one of them
     */
    Span span(List<String> missions) {
        List<RecordedMission> lookup =
                missions.stream().map(this::lookup).filter(each -> each != null).toList();
        if (lookup.size() < missions.size()) {
            return null;
        }
        long first = lookup.stream().mapToLong(RecordedMission::first).min().orElseThrow();
        long last = lookup.stream().mapToLong(RecordedMission::last).max().orElseThrow();
        return new Span(first, last + 1);
    }

    /**
     * A stretch of event time.
     *
     * @param from epoch ms
     * @param to epoch ms, after the last event
     */
    record Span(long from, long to) {}
}
