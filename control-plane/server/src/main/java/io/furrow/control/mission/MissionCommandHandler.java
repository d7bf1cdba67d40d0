package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.OptionalLong;
import java.util.function.Predicate;

import io.furrow.control.domain.DomainMissions;
import io.furrow.control.health.DeviceHealth;
import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

/** Executes or rejects commands on missions and manages their life cycle. A rejected command changes nothing. */
final class MissionCommandHandler implements CommandHandler<MissionCommand>, DomainMissions {
    private final MissionTables tables;
    private final Predicate<String> isDomain;
    private final TemplateStore templates;
    private final DeviceListStore lists;
    private final MissionPlanner planner;
    private final DeviceAssignments devices;
    private final Sequence sequence;
    private final Quota quota;
    private final long timeout;
    private final EventPublisher publisher;

    /** @param farm stores shared with domains */
    MissionCommandHandler(MissionTables tables, SharedStores farm, MissionSettings options, EventPublisher publisher) {
        this.tables = tables;
        this.isDomain = farm.isDomain();
        this.sequence = farm.sequence();
        this.quota = farm.quota();
        this.templates = new TemplateStore(tables.templates(), tables.versions(), farm.quota(), publisher);
        this.lists = new DeviceListStore(tables.lists(), sequence, farm.quota(), publisher);
        this.devices = new DeviceAssignments(tables, lists, options, farm, publisher);
        this.planner = new MissionPlanner(farm, templates, lists, devices);
        this.timeout = options.timeout().toMillis();
        this.publisher = publisher;
    }

    TemplateStore templates() {
        return templates;
    }

    @Override
    public OptionalLong sequenceOf(MissionCommand command) {
        Mission existing = command.mission() == null ? null : tables.missions().get(command.mission());
        return existing == null ? OptionalLong.empty() : OptionalLong.of(existing.sequence());
    }

    @Override
    public CommandResult answer(MissionCommand command, long now) throws RejectedException {
        if (command instanceof MissionCommand.Create create) {
            return create(create, now);
        } else if (command instanceof MissionCommand.Start start) {
            return start(start, now);
        } else if (command instanceof MissionCommand.Stop stop) {
            return stop(stop, now);
        } else if (command instanceof MissionCommand.Delete delete) {
            return delete(delete);
        } else if (command instanceof MissionCommand.AddDevices add) {
            return addDevices(add);
        } else if (command instanceof MissionCommand.SaveTemplate save) {
            MissionTemplate saved = templates.save(save.template());
            return CommandResult.of("created").with("template", saved.name()).with("version", saved.version());
        } else if (command instanceof MissionCommand.RotateCredentials rotate) {
            int generation = devices.rotateCredentials(rotate.device());
            return CommandResult.of("rotated").with("device", rotate.device()).with("generation", generation);
        } else if (command instanceof MissionCommand.DeleteTemplate delete) {
            templates.delete(delete.template(), delete.version());
            return CommandResult.of("deleted").with("template", delete.template());
        }
        throw new IllegalStateException("command " + command + " has no handler");
    }

    private CommandResult create(MissionCommand.Create create, long now) throws RejectedException {
        if (tables.missions().get(create.mission()) != null) {
            throw new RejectedException(
                    ErrorCode.MISSION_EXISTS, "there is a mission '" + create.mission() + "' already");
        }
        Mission mission = planner.plan(null, create.mission(), create.domain(), create.plan(), now)
                .undesired(sequence.next());
        store(mission, MissionStatus.created(mission, now));
        return created(mission);
    }

    private CommandResult start(MissionCommand.Start start, long now) throws RejectedException {
        Mission existing = tables.missions().get(start.mission());
        MissionStatus status = tables.statuses().get(start.mission());
        if (status != null) {
            requireIdle(status, " already");
        }
        String domain = start.domain() == null && existing != null ? existing.domain() : start.domain();
        Mission planned = planner.plan(existing, start.mission(), domain, start.plan(), now);
        long begin = start.start() == null ? now : Math.max(now, start.start().toEpochMilli());
        Long duration =
                start.duration() == null ? null : Long.valueOf(start.duration().toMillis());
        Mission mission = planned.desired(begin, duration, sequence.next());
        int desired = begin > now ? 0 : devices.assign(mission, now);
        MissionStatus before = status == null ? MissionStatus.created(mission, now) : status;
        store(mission, begin > now ? before.scheduled(mission, now) : before.started(mission, desired, timeout, now));
        return begin > now ? created(mission).with("start", begin) : created(mission);
    }

    private CommandResult addDevices(MissionCommand.AddDevices add) throws RejectedException {
        MissionStatus status = existing(add.mission());
        requireIdle(status, "; stop it before devices are added");
        Mission mission = lists.append(tables.missions().get(add.mission()), add.devices())
                .at(sequence.next());
        store(mission, status.listed(mission));
        return CommandResult.of("changed").with("mission", mission.mission()).with("devices", mission.deviceCount());
    }

    private CommandResult stop(MissionCommand.Stop stop, long now) throws RejectedException {
        MissionStatus status = existing(stop.mission());
        boolean scheduled = status.state() == MissionState.CREATED && status.due() != null;
        boolean runs = status.state() == MissionState.STARTING || status.state() == MissionState.RUNNING;
        if (!scheduled && !runs) {
            throw new RejectedException(
                    ErrorCode.MISSION_NOT_RUNNING,
                    "mission '%s' does not run, it is %s"
                            .formatted(stop.mission(), status.state().code()));
        }
        stop(stop.mission(), now);
        return CommandResult.of("deleted").with("mission", stop.mission());
    }

    private void stop(String name, long now) {
        MissionStatus status = tables.statuses().get(name);
        if (status.state() != MissionState.STOPPING) {
            Mission mission = tables.missions().get(name).undesired(sequence.next());
            int simulated = devices.release(mission, now);
            store(mission, status.stopped(mission, simulated, timeout, now));
        }
    }

    @Override
    public List<String> in(String domain) {
        return missions(status -> status.domain().equals(domain));
    }

    @Override
    public List<String> activeIn(String domain) {
        return missions(
                status -> status.domain().equals(domain) && status.state().isActive());
    }

    private List<String> missions(Predicate<MissionStatus> which) {
        return tables.statuses().where(which).stream()
                .map(MissionStatus::mission)
                .toList();
    }

    private CommandResult delete(MissionCommand.Delete delete) throws RejectedException {
        MissionStatus status = existing(delete.mission());
        requireIdle(status, "; stop it first");
        remove(delete.mission());
        return CommandResult.of("deleted").with("mission", delete.mission());
    }

    @Override
    public void remove(String name) {
        Mission mission = tables.missions().get(name);
        devices.forget(mission);
        lists.forget(mission);
        quota.use(-Limits.MISSION_OVERHEAD_BYTES);
        tables.missions().put(name, null);
        tables.statuses().put(name, null);
        publisher.put(Topics.MISSIONS, name, null);
        publisher.put(Topics.MISSIONS_STATUS, name, null);
    }

    /**
     * Processes the status of a device from its host or the provisioner, unless the device or the state is no longer
     * desired. A real device has no host, and once it reports it is up, regardless of other statuses.
     */
    void reported(String key, DeviceStatus report, long now) {
        DeviceState existing = tables.devices().get(key);
        if (existing == null || report.sequence() < existing.device().version().sequence()) {
            return;
        }
        DeviceStatus.State desired =
                existing.device().running() ? DeviceStatus.State.RUNNING : DeviceStatus.State.STOPPED;
        boolean simulated = existing.device().simulated();
        if (simulated || report.state() == DeviceStatus.State.FAILED && !existing.confirmed()) {
            changed(existing, existing.reported(simulated && report.state() == desired, report.reason()), now);
        }
    }

    /** Processes the health of a device: a real one is up after its first report since it was requested. */
    void reported(String key, DeviceHealth health, long now) {
        DeviceState existing = tables.devices().get(key);
        boolean isUp = existing != null
                && !existing.confirmed()
                && !existing.device().simulated()
                && existing.device().running()
                && health.report().heard() != null
                && health.report().heard() >= existing.device().version().from();
        if (isUp) {
            changed(existing, existing.reported(true, null), now);
        }
    }

    /** Processes the connection of a device, which explains why a real one has not reported yet. */
    void reported(String key, DeviceConnection connection, long now) {
        DeviceState existing = tables.devices().get(key);
        if (existing != null && !existing.device().simulated()) {
            DeviceState next = existing.connected(connection);
            if (next != existing) {
                changed(existing, next, now);
            }
        }
    }

    /**
     * Stores a changed device, and counts it for its mission only if it was written after the mission's last change of
     * state: while devices are being written, some records are still older.
     */
    private void changed(DeviceState before, DeviceState after, long now) {
        DeviceVersion version = after.device().version();
        tables.devices().put(version.key(), after);
        MissionStatus status = tables.statuses().get(after.mission());
        boolean counts = status != null && status.state().isActive() && version.sequence() > status.sequence();
        if (counts) {
            MissionStatus next = after.confirmed() == before.confirmed()
                    ? status.explained(after.missing())
                    : status.reported(after.missing(), after.confirmed(), now);
            if (!next.equals(status)) {
                store(next);
            }
        }
    }

    /** Returns the installation of the built-in template and the timed steps of each mission: start dates, durations, late devices. */
    @Override
    public List<Runnable> due(long now) {
        List<Runnable> steps = new ArrayList<>();
        steps.add(templates::installBuiltIn);
        tables.statuses().forEach(status -> {
            boolean ends = status.ends() != null && status.ends() <= now;
            MissionStatus corrected = status.notAfter(now);
            if (corrected != status) {
                steps.add(() -> store(corrected));
            } else if (status.isDue(now) && (ends || !devices.isPending(status.mission()))) {
                steps.add(() -> proceed(status, now));
            }
        });
        return steps;
    }

    /** Returns the next step of each mission whose devices are not all written. */
    @Override
    public List<Runnable> pending(long now) {
        return tables.pending().all().stream()
                .<Runnable>map(pending -> () -> advance(pending, now))
                .toList();
    }

    /** Writes the next devices; the timeout for starting or stopping begins with the last one. */
    private void advance(PendingAssignment pending, long now) {
        if (devices.advance(tables.missions().get(pending.mission()), pending)) {
            MissionStatus status = tables.statuses().get(pending.mission());
            MissionStatus after = status.written(timeout, now);
            if (!after.equals(status)) {
                store(after);
            }
        }
    }

    private void proceed(MissionStatus status, long now) {
        Mission mission = tables.missions().get(status.mission());
        if (status.ends() != null && status.ends() <= now) {
            stop(mission.mission(), now);
        } else if (status.state() == MissionState.CREATED) {
            begin(mission, status, now);
        } else {
            store(status.without(devices.missing(mission), now));
        }
    }

    private void begin(Mission mission, MissionStatus status, long now) {
        try {
            if (!isDomain.test(mission.domain())) {
                throw new RejectedException(
                        ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + mission.domain() + "' any more");
            }
            store(status.started(mission, devices.assign(mission, now), timeout, now));
        } catch (RejectedException e) {
            fail(mission, status, "at the start date: " + e.getMessage(), now);
        }
    }

    private void fail(Mission mission, MissionStatus status, String reason, long now) {
        Mission undesired = mission.undesired(sequence.next());
        store(undesired, status.failed(undesired, reason, now));
    }

    private void store(Mission mission, MissionStatus status) {
        store(mission);
        store(status);
    }

    private void store(Mission mission) {
        tables.missions().put(mission.mission(), mission);
        publisher.put(Topics.MISSIONS, mission.mission(), mission.toBytes());
    }

    private void store(MissionStatus status) {
        tables.statuses().put(status.mission(), status);
        publisher.put(Topics.MISSIONS_STATUS, status.mission(), status.toBytes());
    }

    private static CommandResult created(Mission mission) {
        return CommandResult.of("created")
                .with("mission", mission.mission())
                .with("domain", mission.domain())
                .with("domain_topic", Topics.realtime(mission.domain()))
                .with("mission_topic", Topics.realtime(mission.domain(), mission.mission()));
    }

    private MissionStatus existing(String mission) throws RejectedException {
        MissionStatus status = tables.statuses().get(mission);
        if (status == null) {
            throw new RejectedException(ErrorCode.UNKNOWN_MISSION, "there is no mission '" + mission + "'");
        }
        return status;
    }

    private static void requireIdle(MissionStatus status, String otherwise) throws RejectedException {
        if (status.state().isActive()) {
            throw new RejectedException(
                    ErrorCode.MISSION_RUNNING,
                    "mission '%s' is %s%s"
                            .formatted(status.mission(), status.state().code(), otherwise));
        }
    }
}
