package io.furrow.control.alarm.watch;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.Observer;
import io.furrow.control.mission.MissionState;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;

/** Raises an alarm while devices of a starting or running mission are missing according to its status. */
final class StartAlarmProcessor implements Observer {
    private final AlarmCommandHandler alarms;
    private final Function<String, String> types;
    private final FiwareScope scope;
    /** Reported periodically, because an alarm may ignore a change that follows another one closely. */
    private final Map<String, Cause> causes = new HashMap<>();

    /** @param scope of the devices of missions */
    StartAlarmProcessor(AlarmCommandHandler alarms, Function<String, String> types, FiwareScope scope) {
        this.alarms = alarms;
        this.types = types;
        this.scope = scope;
    }

    @Override
    public void take(Record<String, byte[]> record, long now) throws UnreadableException {
        String mission = record.key();
        MissionStatus status =
                record.value() == null ? null : StateJson.readRecord(record.value(), MissionStatus.class);
        boolean isDesired =
                status != null && (status.state() == MissionState.STARTING || status.state() == MissionState.RUNNING);
        if (isDesired && !status.missing().isEmpty()) {
            Cause cause = cause(mission, status);
            causes.put(mission, cause);
            alarms.report(cause, null, now);
        } else {
            causes.remove(mission);
            alarms.end(
                    AlarmKind.MISSING_DEVICES, AlarmGroup.of(mission, ""), "its devices are up or were stopped", now);
        }
    }

    @Override
    public void passTime(long now) {
        causes.values().forEach(cause -> alarms.report(cause, null, now));
    }

    private Cause cause(String mission, MissionStatus status) {
        List<Cause.AffectedDevice> some = status.missing().stream()
                .map(MissionStatus.Missing::id)
                .map(id -> Cause.AffectedDevice.of(id, types.apply(scope.identity(id)), scope))
                .toList();
        List<Cause.Detail> details = status.missing().stream()
                .filter(each -> each.code() != null)
                .limit(MissionStatus.MAX_EXPLAINED)
                .map(each -> new Cause.Detail(each.id(), each.code(), each.values()))
                .toList();
        return Cause.ofMany(
                        AlarmKind.MISSING_DEVICES,
                        AlarmGroup.of(mission, ""),
                        "mission %s: %s".formatted(mission, status.reason()),
                        some,
                        new Cause.Extent(status.devices() - status.confirmed(), status.devices()))
                .withDetails(details);
    }
}
