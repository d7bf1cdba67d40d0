package io.furrow.control.mission;

import java.time.Duration;
import java.util.List;

import io.furrow.control.domain.Domain;
import io.furrow.control.domain.DomainDesk;
import io.furrow.control.manager.KeptOutbox;
import io.furrow.control.manager.MapRecords;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StateJson;
import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.Response;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;

import static com.fasterxml.jackson.databind.node.JsonNodeFactory.instance;

/** Domains and missions with all they remember in memory. */
final class Farm {
    static final long PATIENCE = 60_000;

    final KeptOutbox outbox = new KeptOutbox();
    final MapRecords<Domain> domains = MapRecords.of(Domain.class);
    final MapRecords<Mission> missions = MapRecords.of(Mission.class);
    final MapRecords<MissionStatus> statuses = MapRecords.of(MissionStatus.class);
    final MapRecords<DeviceState> devices = MapRecords.of(DeviceState.class);
    final MapRecords<MissionTemplate> templates = new MapRecords<>(MissionTemplate::toBytes, Farm::template);
    final MapRecords<Long> sequence = MapRecords.of(Long.class);
    final MissionDesk missionDesk;
    final DomainDesk domainDesk;
    long now = 1_700_000_000_000L;

    Farm() {
        Sequence next = new Sequence(sequence);
        missionDesk = new MissionDesk(
                new MissionRecords(missions, statuses, devices, templates, MapRecords.of(TemplateShelf.Versions.class)),
                name -> domains.get(name) != null,
                new MissionOptions(Duration.ofMillis(PATIENCE), new FiwareScope("farm", "/")),
                next,
                outbox);
        domainDesk = new DomainDesk(domains, missionDesk, next, outbox);
        missionDesk.templates().stock();
    }

    Response ask(MissionCommand command) throws RefusedException {
        return missionDesk.answer(command, now);
    }

    Response ask(DomainCommand command) throws RefusedException {
        return domainDesk.answer(command, now);
    }

    void domain(String name) throws RefusedException {
        ask(new DomainCommand.Create(name, DomainDetails.NONE));
    }

    Response start(String mission, String domain, DeviceGroup... groups) throws RefusedException {
        return ask(new MissionCommand.Start(mission, domain, devices(groups), null, null));
    }

    static MissionPlan devices(DeviceGroup... groups) {
        return new MissionPlan.OfDevices(new MissionDevices(List.of(groups)));
    }

    static DeviceGroup group(String type, int count) {
        return new DeviceGroup(null, null, type, count, null, null, instance.objectNode());
    }

    MissionStatus status(String mission) {
        return statuses.get(mission);
    }

    WantedDevice device(String id) {
        return devices.get("farm|/|" + id).device();
    }

    void report(WantedDevice device, DeviceStatus.State state) {
        missionDesk.reported(
                device.version().key(),
                new DeviceStatus(device.version().sequence(), state, state == DeviceStatus.State.FAILED ? "why" : null),
                now);
    }

    /** Whoever hosts devices does what is wanted. */
    void hostAll() {
        for (DeviceState each : devices.all()) {
            WantedDevice device = each.device();
            report(device, device.running() ? DeviceStatus.State.RUNNING : DeviceStatus.State.STOPPED);
        }
    }

    void pass(long millis) {
        now += millis;
        missionDesk.passTime(now);
    }

    /** Everything that is remembered. */
    String content() {
        return domains.content()
                + missions.content()
                + statuses.content()
                + devices.content()
                + templates.content()
                + sequence.content();
    }

    private static MissionTemplate template(byte[] value) {
        try {
            return MissionTemplate.read(value);
        } catch (RefusedException e) {
            throw new IllegalStateException(e);
        }
    }

    static String json(Object state) {
        return new String(StateJson.write(state));
    }
}
