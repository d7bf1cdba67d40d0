package io.furrow.control.replay;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.OptionalLong;
import java.util.UUID;
import java.util.function.Supplier;

import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.Table;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RejectedException;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.text.Counts;
import io.furrow.model.topic.Topics;

/**
 * Executes or rejects commands on replays, and publishes their desired state on {@code service.replays}. The player
 * reports their actual state on {@code service.replays.status}.
 */
final class ReplayCommandHandler implements CommandHandler<ReplayCommand> {
    /** Latest time that a request may contain, epoch ms; recordings may contain later ones. */
    private static final long LAST_TIME = Instant.parse("9999-12-31T23:59:59Z").toEpochMilli();

    private static final Duration MAX_AHEAD = Duration.ofDays(30);
    private static final String REPLAY = "replay";
    private static final String GROUP = "group";

    private final Table<DesiredReplay> replays;
    private final ReplayReports reports;
    private final RecordedMissions recordings;
    private final ReplayNames names;
    private final Sequence sequence;
    private final Quota quota;
    private final ReplaySettings settings;
    private final EventPublisher publisher;

    /**
     * @param stores of the replays
     * @param ids of new replays
     */
    ReplayCommandHandler(
            ReplayStores stores,
            RecordedMissions recordings,
            Supplier<UUID> ids,
            ReplaySettings settings,
            EventPublisher publisher) {
        this.replays = stores.replays();
        this.reports = new ReplayReports(stores.reports());
        this.recordings = recordings;
        this.names = new ReplayNames(replays, ids);
        this.sequence = new Sequence(stores.counters());
        this.quota = new Quota(stores.counters(), Limits.DEFINITIONS_BYTES);
        this.settings = settings;
        this.publisher = publisher;
    }

    /**
     * The stores of the replay manager.
     *
     * @param counters of the sequence and of the used quota
     */
    record ReplayStores(Table<DesiredReplay> replays, Table<ReportedReplay> reports, Table<Long> counters) {}

    @Override
    public OptionalLong sequenceOf(ReplayCommand command) {
        DesiredReplay existing = command instanceof ReplayCommand.Steering steering
                        && steering.target().replay() != null
                ? replays.get(steering.target().replay())
                : null;
        return existing == null ? OptionalLong.empty() : OptionalLong.of(existing.sequence());
    }

    @Override
    public CommandResult answer(ReplayCommand command, long now) throws RejectedException {
        if (command instanceof ReplayCommand.Start start) {
            check(start, now);
            return start.isGroup() ? startGroup(start, now) : start(start, now);
        }
        ReplayCommand.Steering steering = (ReplayCommand.Steering) command;
        return steering.target().group() == null ? steer(steering) : steerGroup(steering, now);
    }

    private void check(ReplayCommand.Start start, long now) throws RejectedException {
        Long startAt = start.plan().startAt();
        if (startAt != null && startAt > now + MAX_AHEAD.toMillis()) {
            throw new RejectedException(
                    ErrorCode.WRONG_MEMBER, "'startAt' must be at most %d days ahead".formatted(MAX_AHEAD.toDays()));
        }
        if (start.plan().source() == null) {
            recordings.require(start.missions());
        }
        requireRoom(start.missions().size());
    }

    /** Limits the number of replays that are not over, because each uses a topic, and heap and connections of its job. */
    private void requireRoom(int additional) throws RejectedException {
        int playing = replays.where(each -> !reports.state(each).isOver()).size();
        if (playing + additional > settings.max()) {
            throw new RejectedException(
                    ErrorCode.QUOTA_EXCEEDED,
                    "%s not over, of at most %d (--max-replays); stop one that is not needed any more"
                            .formatted(Counts.are(playing, "replay"), settings.max()));
        }
    }

    private CommandResult start(ReplayCommand.Start start, long now) throws RejectedException {
        String mission = start.missions().get(0);
        String topic = start.topic() == null ? Topics.replay(mission, names.newId(start.missions())) : start.topic();
        DesiredReplay replay = desired(start, mission, topic, start.plan(), now, sequence.next());
        names.require(replay);
        store(null, replay);
        return CommandResult.of("created").with(REPLAY, replay.replay()).with("topic", replay.topic());
    }

    private CommandResult startGroup(ReplayCommand.Start start, long now) throws RejectedException {
        ReplayPlan plan = groupPlan(start);
        String id = names.newId(start.missions());
        long number = sequence.next();
        List<DesiredReplay> members = new ArrayList<>();
        for (String mission : start.missions()) {
            DesiredReplay member = desired(start, mission, Topics.replay(mission, id), plan, now, number);
            ReplayGroup.checkRange(member, start.range());
            members.add(member);
        }
        List<DesiredReplay> group = ReplayGroup.started(members, id, now);
        for (DesiredReplay member : group) {
            store(null, member);
        }
        return about(CommandResult.of("created"), id, group)
                .with("topics", group.stream().map(DesiredReplay::topic).toList());
    }

    private static DesiredReplay desired(
            ReplayCommand.Start start, String mission, String topic, ReplayPlan plan, long now, long number) {
        return DesiredReplay.started(mission, topic, plan, start.speed(), now, number)
                .within(start.range(), number);
    }

    /** Returns the plan of all members: they play the same range of event time, by default the union of their recordings. */
    private ReplayPlan groupPlan(ReplayCommand.Start start) throws RejectedException {
        ReplayPlan plan = start.plan();
        RecordedMissions.Span all = recordings.span(start.missions());
        if (all == null && (plan.from() == null || plan.to() == null)) {
            throw new RejectedException(
                    ErrorCode.MISSING_MEMBER,
                    "a group needs 'from' and 'to': where the control plane has no --mongo, it does not know when missions begin and end");
        }
        long from = plan.from() == null ? all.from() : plan.from();
        long to = plan.to() == null ? all.to() : plan.to();
        if (from >= to || to <= 0 || from >= LAST_TIME) {
            throw new RejectedException(
                    ErrorCode.WRONG_MEMBER,
                    "'from' must be before the end of the played range: 'from' is %s, the end is %s"
                            .formatted(Instant.ofEpochMilli(from), Instant.ofEpochMilli(to)));
        }
        return plan.between(Math.max(0, from), Math.min(to, LAST_TIME));
    }

    private CommandResult steer(ReplayCommand.Steering steering) throws RejectedException {
        DesiredReplay existing = replays.get(steering.target().replay());
        if (existing == null) {
            throw unknown(steering);
        }
        if (existing.group() != null) {
            throw new RejectedException(
                    ErrorCode.WRONG_STATE,
                    "replay '%s' follows the clock of group '%s'; steer the group"
                            .formatted(existing.replay(), existing.group()));
        }
        ReplayStatus.State state = reports.state(existing);
        ReplayReports.check(steering, state);
        if (steering instanceof ReplayCommand.Seek seek) {
            recordings.requireWithin(seek.to().toEpochMilli(), existing, reports.get(existing));
        }
        DesiredReplay next = next(steering, existing, state);
        store(existing, next);
        return CommandResult.of(code(existing, state, next)).with(REPLAY, next.replay());
    }

    private CommandResult steerGroup(ReplayCommand.Steering steering, long now) throws RejectedException {
        List<DesiredReplay> existing = members(steering.target().group());
        if (existing.isEmpty()) {
            throw unknown(steering);
        }
        ReplayGroup group = new ReplayGroup(existing);
        group.check(steering);
        ReplayStatus.State state = reports.state(existing);
        ReplayReports.check(steering, state);
        List<DesiredReplay> next = group.steered(steering, now, sequence.next());
        for (int i = 0; i < next.size(); i++) {
            store(existing.get(i), next.get(i));
        }
        return about(
                CommandResult.of(code(existing.get(0), state, next.get(0))),
                steering.target().group(),
                next);
    }

    private List<DesiredReplay> members(String group) {
        return replays.where(each -> group.equals(each.group()));
    }

    private static CommandResult about(CommandResult answer, String group, List<DesiredReplay> members) {
        return answer.with(GROUP, group)
                .with("replays", members.stream().map(DesiredReplay::replay).toList());
    }

    /** Returns the result code: a finished replay is neither running nor paused until it is requested to play again. */
    private static String code(DesiredReplay existing, ReplayStatus.State state, DesiredReplay next) {
        if (next.desired() == ReplayStatus.State.STOPPED) {
            return "deleted";
        }
        boolean playsAgain =
                !Objects.equals(existing.seek(), next.seek()) || !Objects.equals(existing.step(), next.step());
        return state.isOver() && !playsAgain ? "changed" : next.desired().code();
    }

    private static RejectedException unknown(ReplayCommand.Steering steering) {
        return new RejectedException(
                ErrorCode.UNKNOWN_REPLAY, "there is no %s, or it is over".formatted(steering.target()));
    }

    /** @param state its current state */
    private DesiredReplay next(ReplayCommand.Steering steering, DesiredReplay existing, ReplayStatus.State state) {
        long number = sequence.next();
        if (steering instanceof ReplayCommand.Seek seek) {
            return existing.seeking(seek.to().toEpochMilli(), number);
        } else if (steering instanceof ReplayCommand.Speed speed) {
            return existing.at(speed.speed(), number);
        } else if (steering instanceof ReplayCommand.Step step) {
            return existing.desired(ReplayStatus.State.PAUSED, number).stepping(step.count(), number);
        } else if (steering instanceof ReplayCommand.Loop loop) {
            DesiredReplay within = existing.within(loop.range(), number);
            return state.isOver() && loop.range() != null ? within.seeking(within.from(0), number) : within;
        }
        return switch (((ReplayCommand.Simple) steering).what()) {
            case STOP -> existing.desired(ReplayStatus.State.STOPPED, number);
            case PAUSE -> existing.desired(ReplayStatus.State.PAUSED, number);
            case RESUME -> existing.desired(ReplayStatus.State.RUNNING, number);
        };
    }

    /** Removes a replay that was stopped or has finally failed, unless it got a newer command; one that ended is retained for a while. */
    void reported(String replay, ReplayStatus report, long now) {
        if (!replays.contains(replay)) {
            return;
        }
        reports.take(replay, report, now);
        if (report.state().isOver() && report.settled() && report.state() != ReplayStatus.State.ENDED) {
            DesiredReplay existing = replays.get(replay);
            if (report.sequence() >= existing.sequence()) {
                remove(existing);
            }
        }
    }

    /** Removes replays that ended longer ago than the retention; members of a group together. */
    @Override
    public void passTime(long now) {
        List<DesiredReplay> expired = reports
                .endedBy(now - settings.endedRetention().toMillis())
                .stream()
                .map(replays::get)
                .filter(each -> reports.state(each).isOver())
                .toList();
        for (DesiredReplay each : expired) {
            if (each.group() == null || expired.containsAll(members(each.group()))) {
                remove(each);
            }
        }
    }

    private void remove(DesiredReplay existing) {
        quota.use(-existing.toBytes().length);
        replays.put(existing.replay(), null);
        reports.remove(existing.replay());
        publisher.put(Topics.REPLAYS, existing.replay(), null);
    }

    /** @param before null if there was none */
    private void store(DesiredReplay before, DesiredReplay replay) throws RejectedException {
        byte[] value = replay.toBytes();
        if (before == null) {
            quota.replace(null, value);
        } else {
            quota.use(value.length
                    - before.toBytes().length); // commands to existing replays are not limited by the quota
        }
        replays.put(replay.replay(), replay);
        publisher.put(Topics.REPLAYS, replay.replay(), value);
    }
}
