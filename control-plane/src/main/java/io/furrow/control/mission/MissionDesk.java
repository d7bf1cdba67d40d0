package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ArrayNode;

import io.furrow.control.domain.DomainMissions;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.Response;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;

/** Grants or refuses what is asked of missions, and takes them through their life. What is refused has changed nothing. */
public final class MissionDesk implements DomainMissions {
    private final MissionRecords records;
    private final Predicate<String> isDomain;
    private final TemplateShelf templates;
    private final DeviceDesk devices;
    private final Sequence sequence;
    private final long patience;
    private final Outbox outbox;

    /** @param isDomain whether there is a domain of a name */
    MissionDesk(
            MissionRecords records,
            Predicate<String> isDomain,
            MissionOptions options,
            Sequence sequence,
            Outbox outbox) {
        this.records = records;
        this.isDomain = isDomain;
        this.templates = new TemplateShelf(records.templates(), records.versions(), outbox);
        this.devices = new DeviceDesk(records.devices(), sequence, options.scope(), outbox);
        this.sequence = sequence;
        this.patience = options.patience().toMillis();
        this.outbox = outbox;
    }

    public TemplateShelf templates() {
        return templates;
    }

    /** @param now epoch ms */
    public Response answer(MissionCommand command, long now) throws RefusedException {
        if (command instanceof MissionCommand.Create create) {
            return create(create, now);
        } else if (command instanceof MissionCommand.Start start) {
            return start(start, now);
        } else if (command instanceof MissionCommand.Stop stop) {
            return stop(stop, now);
        } else if (command instanceof MissionCommand.Delete delete) {
            return delete(delete);
        } else if (command instanceof MissionCommand.SaveTemplate save) {
            MissionTemplate saved = templates.save(save.template());
            return Response.of("created").with("template", saved.name()).with("version", saved.version());
        }
        MissionCommand.DeleteTemplate delete = (MissionCommand.DeleteTemplate) command;
        templates.delete(delete.template(), delete.version());
        return Response.of("deleted").with("template", delete.template());
    }

    private Response create(MissionCommand.Create create, long now) throws RefusedException {
        if (records.missions().get(create.mission()) != null) {
            throw new RefusedException(
                    ErrorCode.MISSION_EXISTS, "there is a mission '" + create.mission() + "' already");
        }
        Mission mission = planned(null, create.mission(), create.domain(), create.plan(), now)
                .unwanted(sequence.next());
        keep(mission, MissionStatus.created(mission, now));
        return created(mission);
    }

    private Response start(MissionCommand.Start start, long now) throws RefusedException {
        Mission known = records.missions().get(start.mission());
        MissionStatus status = records.statuses().get(start.mission());
        if (status != null && status.state().isActive()) {
            throw new RefusedException(
                    ErrorCode.MISSION_RUNNING,
                    "mission '%s' is %s already"
                            .formatted(start.mission(), status.state().word()));
        }
        String domain = start.domain() == null && known != null ? known.domain() : start.domain();
        Mission planned = planned(known, start.mission(), domain, start.plan(), now);
        long begin = start.start() == null ? now : Math.max(now, start.start().toEpochMilli());
        Long duration =
                start.duration() == null ? null : Long.valueOf(start.duration().toMillis());
        int hosted = begin > now ? 0 : devices.ask(planned, now);
        Mission mission = planned.wanted(begin, duration, sequence.next());
        MissionStatus before = status == null ? MissionStatus.created(mission, now) : status;
        if (known != null && !known.devices().equals(mission.devices())) {
            devices.forgetAllBut(known, mission);
        }
        keep(mission, begin > now ? before.scheduled(mission, now) : before.started(mission, hosted, patience, now));
        return created(mission);
    }

    /** The mission with the devices that are asked for; those of a template as it is now. */
    private Mission planned(Mission known, String name, String domain, MissionPlan plan, long now)
            throws RefusedException {
        if (domain == null) {
            throw new RefusedException(ErrorCode.MISSING_MEMBER, "a new mission needs a member 'domain'");
        }
        if (known != null && !known.domain().equals(domain)) {
            throw new RefusedException(
                    ErrorCode.NAME_TAKEN,
                    "mission '%s' belongs to domain '%s'; choose another name".formatted(name, known.domain()));
        }
        if (!isDomain.test(domain)) {
            throw new RefusedException(
                    ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + domain + "'; create it first");
        }
        ArrayNode none = MissionDevices.NONE.toJson();
        Mission mission = known != null ? known : new Mission(name, domain, null, none, false, null, null, now, 0);
        if (plan instanceof MissionPlan.OfDevices of) {
            return mission.with(null, of.devices().toJson());
        } else if (plan instanceof MissionPlan.FromTemplate from) {
            MissionTemplate template = templates.find(from.template(), from.version());
            return mission.with(template.key(), template.devices().toJson());
        }
        return mission;
    }

    private Response stop(MissionCommand.Stop stop, long now) throws RefusedException {
        MissionStatus status = records.statuses().get(stop.mission());
        if (status == null) {
            throw unknown(stop.mission());
        }
        boolean scheduled = status.state() == MissionState.CREATED && status.due() != null;
        boolean runs = status.state() == MissionState.STARTING || status.state() == MissionState.RUNNING;
        if (!scheduled && !runs) {
            throw new RefusedException(
                    ErrorCode.MISSION_NOT_RUNNING,
                    "mission '%s' does not run, it is %s"
                            .formatted(stop.mission(), status.state().word()));
        }
        stop(stop.mission(), now);
        return Response.of("deleted").with("mission", stop.mission());
    }

    @Override
    public void stop(String name, long now) {
        MissionStatus status = records.statuses().get(name);
        if (status.state() != MissionState.STOPPING) {
            Mission mission = records.missions().get(name).unwanted(sequence.next());
            devices.dismiss(mission, now);
            keep(mission, status.stopped(mission, patience, now));
        }
    }

    @Override
    public List<String> activeIn(String domain) {
        List<String> active = new ArrayList<>();
        records.statuses().forEach(status -> {
            if (status.domain().equals(domain) && status.state().isActive()) {
                active.add(status.mission());
            }
        });
        return active;
    }

    private Response delete(MissionCommand.Delete delete) throws RefusedException {
        MissionStatus status = records.statuses().get(delete.mission());
        if (status == null) {
            throw unknown(delete.mission());
        }
        if (status.state().isActive()) {
            throw new RefusedException(
                    ErrorCode.MISSION_RUNNING,
                    "mission '%s' is %s; stop it first"
                            .formatted(delete.mission(), status.state().word()));
        }
        devices.forget(records.missions().get(delete.mission()));
        records.missions().put(delete.mission(), null);
        records.statuses().put(delete.mission(), null);
        outbox.put(Topics.MISSIONS, delete.mission(), null);
        outbox.put(Topics.MISSIONS_STATUS, delete.mission(), null);
        return Response.of("deleted").with("mission", delete.mission());
    }

    /** What the host of a device says; of a device or a state that is no longer wanted nothing is taken. */
    public void reported(String key, DeviceStatus told, long now) {
        DeviceState known = records.devices().get(key);
        if (known == null || told.sequence() < known.device().version().sequence()) {
            return;
        }
        DeviceStatus.State wanted = known.device().running() ? DeviceStatus.State.RUNNING : DeviceStatus.State.STOPPED;
        boolean asWanted = told.state() == wanted;
        records.devices().put(key, known.reported(asWanted, told.reason()));
        MissionStatus status = records.statuses().get(known.mission());
        boolean counts =
                known.device().isHosted() && status != null && status.state().isActive();
        if (counts && asWanted != known.confirmed()) {
            String id = known.device().version().id();
            keep(status.reported(new MissionStatus.Missing(id, told.reason()), asWanted, now));
        }
    }

    /** Takes on what waits for no one but the time: start dates, durations, devices that are late. */
    public void passTime(long now) {
        List<MissionStatus> due = new ArrayList<>();
        records.statuses().forEach(status -> {
            if (status.isDue(now)) {
                due.add(status);
            }
        });
        due.forEach(status -> goOn(status, now));
    }

    private void goOn(MissionStatus status, long now) {
        Mission mission = records.missions().get(status.mission());
        if (status.ends() != null && status.ends() <= now) {
            stop(mission.mission(), now);
        } else if (status.state() == MissionState.CREATED) {
            begin(mission, status, now);
        } else if (status.state() == MissionState.STARTING && status.confirmed() == 0) {
            devices.dismiss(mission, now);
            fail(
                    mission,
                    status,
                    "none of %d devices came up within %d s".formatted(status.devices(), patience / 1000),
                    now);
        } else {
            keep(status.without(devices.missing(mission), now));
        }
    }

    private void begin(Mission mission, MissionStatus status, long now) {
        try {
            if (!isDomain.test(mission.domain())) {
                throw new RefusedException(
                        ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + mission.domain() + "' any more");
            }
            keep(status.started(mission, devices.ask(mission, now), patience, now));
        } catch (RefusedException e) {
            fail(mission, status, "at the start date: " + e.getMessage(), now);
        }
    }

    private void fail(Mission mission, MissionStatus status, String reason, long now) {
        Mission unwanted = mission.unwanted(sequence.next());
        keep(unwanted, status.failed(unwanted, reason, now));
    }

    private void keep(Mission mission, MissionStatus status) {
        records.missions().put(mission.mission(), mission);
        outbox.put(Topics.MISSIONS, mission.mission(), mission.toBytes());
        keep(status);
    }

    private void keep(MissionStatus status) {
        records.statuses().put(status.mission(), status);
        outbox.put(Topics.MISSIONS_STATUS, status.mission(), status.toBytes());
    }

    private static Response created(Mission mission) {
        return Response.of("created")
                .with("mission", mission.mission())
                .with("domain", mission.domain())
                .with("domain_topic", Topics.realtime(mission.domain()))
                .with("mission_topic", Topics.realtime(mission.domain(), mission.mission()));
    }

    private static RefusedException unknown(String mission) {
        return new RefusedException(ErrorCode.UNKNOWN_MISSION, "there is no mission '" + mission + "'");
    }
}
