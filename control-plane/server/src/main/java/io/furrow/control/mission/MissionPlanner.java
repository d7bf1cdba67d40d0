package io.furrow.control.mission;

import java.util.List;
import java.util.function.Predicate;

import io.furrow.control.manager.Quota;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RejectedException;

/** Plans a mission: resolves template and groups to a list of devices, or rejects the request. */
final class MissionPlanner {
    private final Predicate<String> isDomain;
    private final TemplateStore templates;
    private final DeviceListStore lists;
    private final DeviceAssignments devices;
    private final Quota quota;

    /** @param farm stores shared with domains */
    MissionPlanner(SharedStores farm, TemplateStore templates, DeviceListStore lists, DeviceAssignments devices) {
        this.isDomain = farm.isDomain();
        this.quota = farm.quota();
        this.templates = templates;
        this.lists = lists;
        this.devices = devices;
    }

    /** Returns the mission with the requested devices; those of a template are copied. */
    Mission plan(Mission existing, String name, String domain, MissionPlan plan, long now) throws RejectedException {
        if (domain == null) {
            throw new RejectedException(ErrorCode.MISSING_MEMBER, "a new mission needs a member 'domain'");
        }
        if (existing != null && !existing.domain().equals(domain)) {
            throw new RejectedException(
                    ErrorCode.NAME_TAKEN,
                    "mission '%s' belongs to domain '%s'; choose another name".formatted(name, existing.domain()));
        }
        if (!isDomain.test(domain)) {
            throw new RejectedException(
                    ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + domain + "'; create it first");
        }
        Mission mission = existing == null ? create(name, domain, now) : existing;
        if (plan instanceof MissionPlan.OfDevices of) {
            return listing(mission.from(null), of.devices());
        } else if (plan instanceof MissionPlan.FromTemplate from) {
            MissionTemplate template = templates.find(from.template(), from.version());
            return listing(mission.from(template.key()), template.devices());
        }
        return mission;
    }

    private Mission create(String name, String domain, long now) throws RejectedException {
        quota.require(Limits.MISSION_OVERHEAD_BYTES);
        quota.use(Limits.MISSION_OVERHEAD_BYTES);
        return Mission.of(name, domain, now);
    }

    /** Replaces the device list; records of devices that are no longer listed are deleted. */
    private Mission listing(Mission mission, MissionDevices list) throws RejectedException {
        List<DeviceState> before = devices.of(mission);
        Mission after = lists.replace(mission, list);
        devices.forgetAllBut(before, after);
        return after;
    }
}
