package io.furrow.control.replay;

import java.util.List;

import io.furrow.control.manager.Table;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;

/** Stores the reported state of replays and checks which commands it allows. */
record ReplayReports(Table<ReportedReplay> reports) {
    /** Stores a report if it differs from the previous one. @param now epoch ms */
    void take(String replay, ReplayStatus report, long now) {
        ReportedReplay before = reports.get(replay);
        ReportedReplay next = ReportedReplay.of(replay, report, before, now);
        if (!next.equals(before)) {
            reports.put(replay, next);
        }
    }

    void remove(String replay) {
        reports.put(replay, null);
    }

    ReportedReplay get(DesiredReplay replay) {
        return reports.get(replay.replay());
    }

    /** Returns the reported state if the replay is over, else the desired state. */
    State state(DesiredReplay replay) {
        ReportedReplay report = get(replay);
        return report != null && report.isOver(replay.sequence()) && replay.desired() != State.STOPPED
                ? report.state()
                : replay.desired();
    }

    /** Returns the state of a group, which is over when all of its members are. */
    State state(List<DesiredReplay> members) {
        DesiredReplay one = members.get(0);
        return members.stream().allMatch(each -> state(each).isOver()) ? state(one) : one.desired();
    }

    /** Returns the names of replays that had ended by a time. @param time epoch ms */
    List<String> endedBy(long time) {
        return reports.where(each -> each.ended() != null && each.ended() <= time).stream()
                .map(ReportedReplay::replay)
                .toList();
    }

    /** @throws RejectedException if the command is not allowed in this state */
    static void check(ReplayCommand.Steering steering, State state) throws RejectedException {
        boolean pauses = isSimple(steering, ReplayCommand.Verb.PAUSE);
        boolean resumes = isSimple(steering, ReplayCommand.Verb.RESUME);
        boolean isAllowed = switch (state) {
            case RUNNING -> !resumes && !(steering instanceof ReplayCommand.Step);
            case PAUSED -> !pauses;
            case ENDED -> !pauses && !resumes && !(steering instanceof ReplayCommand.Step step && step.count() > 0);
            case FAILED -> !pauses && !resumes && !(steering instanceof ReplayCommand.Step);
            case STOPPED -> false;
        };
        if (!isAllowed) {
            throw new RejectedException(
                    ErrorCode.WRONG_STATE,
                    "%s is %s, which '%s' cannot change%s"
                            .formatted(
                                    steering.target(),
                                    state.code(),
                                    steering.verb(),
                                    state == State.ENDED ? "; 'seek' plays it again" : ""));
        }
    }

    private static boolean isSimple(ReplayCommand.Steering steering, ReplayCommand.Verb verb) {
        return steering instanceof ReplayCommand.Simple simple && simple.what() == verb;
    }
}
