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
 * Looks up recorded missions listed on {@code service.recordings}.
 *
 * @param checked whether that list is maintained; else any mission may be recorded
 * @param find returns a recording by mission; null if none is listed
 */
record RecordedMissions(boolean checked, Function<String, RecordedMission> find) {
    /** @throws RejectedException if one of the missions is known not to be recorded */
    void require(List<String> missions) throws RejectedException {
        List<String> unknown =
                missions.stream().filter(each -> lookup(each) == null).toList();
        if (checked && !unknown.isEmpty()) {
            throw new RejectedException(
                    ErrorCode.UNKNOWN_MISSION,
                    "mission '%s' is not recorded; './furrow replay missions' and GET /api/recordings list the recorded ones"
                            .formatted(String.join("', '", unknown)));
        }
    }

    /** Looks up a mission by its name, else by its name in topics, which rarely differs. */
    private RecordedMission lookup(String mission) {
        RecordedMission listed = find.apply(mission);
        return listed == null ? find.apply(TopicName.of(mission)) : listed;
    }

    /**
     * Rejects a time outside of the known recording or the requested range of a replay. A running mission may be longer
     * than listed; until the replay reports the last event, any later time is accepted.
     *
     * @param time of an event, epoch ms
     * @param reported null if the replay has not reported yet
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
     * Returns the time from the first event of the missions to after their last.
     *
     * @return null if one of them is not listed
     */
    Span span(List<String> missions) {
        List<RecordedMission> listed =
                missions.stream().map(this::lookup).filter(each -> each != null).toList();
        if (listed.size() < missions.size()) {
            return null;
        }
        long first = listed.stream().mapToLong(RecordedMission::first).min().orElseThrow();
        long last = listed.stream().mapToLong(RecordedMission::last).max().orElseThrow();
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
