package io.furrow.control.mission;

import java.time.Duration;
import java.util.List;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;

import io.furrow.control.domain.Domain;
import io.furrow.control.domain.DomainCommandHandler;
import io.furrow.control.domain.DomainManager;
import io.furrow.control.health.DeviceHealth;
import io.furrow.control.manager.CapturingPublisher;
import io.furrow.control.manager.Table;
import io.furrow.control.manager.TestStores;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

import static com.fasterxml.jackson.databind.node.JsonNodeFactory.instance;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Runs the handlers of domains and missions with their stores, without Kafka. */
final class FarmFixture {
    static final long TIMEOUT = 60_000;

    private final TestStores stores =
            new TestStores(Stream.of(DomainManager.stores(), MissionManager.stores(), List.of("fields"))
                    .flatMap(List::stream)
                    .toList());

    final CapturingPublisher publisher = stores.publisher();
    final Table<Domain> domains = stores.unitOfWork().table("domains", Domain.class);
    final Table<Mission> missions = stores.unitOfWork().table("missions", Mission.class);
    final Table<MissionStatus> statuses = stores.unitOfWork().table("mission-statuses", MissionStatus.class);
    final Table<DeviceState> devices = stores.unitOfWork().table("devices", DeviceState.class);
    final Table<PendingAssignment> rollouts = stores.unitOfWork().table("mission-rollouts", PendingAssignment.class);
    final Table<FieldVersion> fields = stores.unitOfWork().table("fields", FieldVersion::toBytes, bytes -> {
        throw new AssertionError("only the handler reads them");
    });
    final MissionCommandHandler missionHandler;
    final DomainCommandHandler domainHandler;
    long now = 1_700_000_000_000L;

    FarmFixture() {
        this(500);
    }

    FarmFixture(int devicesPerStep) {
        MissionSettings options =
                new MissionSettings(Duration.ofMillis(TIMEOUT), new FiwareScope("farm", "/"), false, devicesPerStep);
        missionHandler = MissionManager.handler(stores.unitOfWork(), options);
        domainHandler = DomainManager.handler(stores.unitOfWork(), missionHandler);
        run(missionHandler.templates()::installBuiltIn);
    }

    CommandResult request(MissionCommand command) throws RejectedException {
        return stores.call(now, () -> missionHandler.answer(command, now));
    }

    CommandResult request(DomainCommand command) throws RejectedException {
        return stores.call(now, () -> domainHandler.answer(command, now));
    }

    void run(Runnable work) {
        stores.call(now, () -> {
            work.run();
            return null;
        });
    }

    <T> List<T> all(Table<T> records) {
        return stores.all(records);
    }

    void domain(String name) throws RejectedException {
        request(new DomainCommand.Create(name, DomainDetails.NONE));
    }

    /** Adds a field of {@code service.fields}. */
    void field(String id, long validFrom, String domain) {
        FieldVersion version = new FieldVersion(
                id,
                validFrom,
                instance.objectNode().put("type", "Polygon"),
                instance.objectNode().put("Domain", domain));
        run(() -> fields.put(version.key(), version));
    }

    CommandResult start(String mission, String domain, DeviceGroup... groups) throws RejectedException {
        return request(new MissionCommand.Start(mission, domain, devices(groups), null, null));
    }

    static MissionPlan devices(DeviceGroup... groups) {
        return new MissionPlan.OfDevices(new MissionDevices(List.of(groups)));
    }

    /** Real devices, listed by id. */
    static DeviceGroup real(String type, int count) {
        return new DeviceGroup(null, null, type, count, null, null, false, instance.objectNode());
    }

    static DeviceGroup group(String type, int count) {
        return new DeviceGroup(null, null, type, count, null, null, true, instance.objectNode());
    }

    MissionStatus status(String mission) {
        return statuses.get(mission);
    }

    DesiredDevice device(String id) {
        return devices.get("farm|/|" + id).device();
    }

    /** Returns the settings of a device as its host resolves them. */
    ObjectNode settings(String id) throws UnreadableException {
        MissionDeviceLists lists = new MissionDeviceLists();
        publisher.compacted(Topics.MISSION_DEVICES).forEach(lists::take);
        return lists.resolve(device(id)).orElseThrow().settings();
    }

    void report(DesiredDevice device, DeviceStatus.State state) {
        DeviceStatus status =
                new DeviceStatus(device.version().sequence(), state, state == DeviceStatus.State.FAILED ? "why" : null);
        run(() -> missionHandler.reported(device.version().key(), status, now));
    }

    /** Receives a report of a device at a time. */
    void report(DesiredDevice device, long heard) {
        DeviceVersion version = device.version();
        DeviceHealth health = new DeviceHealth(
                new DeviceHealth.Device(
                        version.id(),
                        version.service(),
                        version.servicePath(),
                        device.type(),
                        version.domain(),
                        version.mission()),
                false,
                heard,
                new DeviceHealth.NewestReport(heard, heard, null, null, false, false));
        run(() -> missionHandler.reported(version.key(), health, now));
    }

    /** Reports the connection of a device that has not logged in. @param refused null if no login was refused */
    void connect(DesiredDevice device, RefusedLogin refused) {
        DeviceConnection connection = new DeviceConnection(now - TIMEOUT, null, refused, null, null, true);
        run(() -> missionHandler.reported(device.version().key(), connection, now));
    }

    /** Confirms all desired states: hosts report simulated devices, and real devices report. */
    void hostAll() {
        for (DeviceState each : all(devices)) {
            DesiredDevice device = each.device();
            if (device.simulated()) {
                report(device, device.running() ? DeviceStatus.State.RUNNING : DeviceStatus.State.STOPPED);
            } else {
                report(device, now);
            }
        }
    }

    void pass(long millis) {
        now += millis;
        missionHandler.due(now).forEach(this::run);
    }

    /** Writes the next devices of pending assignments. Returns whether there were any. */
    boolean step() {
        List<Runnable> pending = missionHandler.pending(now);
        pending.forEach(this::run);
        return !pending.isEmpty();
    }

    String content() {
        return stores.content();
    }

    static String json(Object state) {
        return new String(StateJson.write(state));
    }

    /** Expects a rejection that changes nothing. */
    void rejects(ErrorCode code, ThrowingCallable call) {
        String before = content();
        int written = publisher.all().size();
        assertThatThrownBy(call)
                .isInstanceOfSatisfying(
                        RejectedException.class, e -> assertThat(e.code()).isEqualTo(code));
        assertThat(content()).isEqualTo(before);
        assertThat(publisher.all()).hasSize(written);
    }
}
