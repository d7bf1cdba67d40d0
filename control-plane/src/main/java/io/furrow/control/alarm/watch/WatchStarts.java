package io.furrow.control.alarm.watch;

import java.util.List;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.control.mission.MissionState;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.control.AlarmKind;

/** Raises an alarm while devices of a mission that starts or runs are missing, as its status says. */
final class WatchStarts {
    private final AlarmCommandHandler alarms;

    WatchStarts(AlarmCommandHandler alarms) {
        this.alarms = alarms;
    }

    /**
     * @param status null if the mission was deleted
     * @param now epoch ms
     */
    void take(String mission, MissionStatus status, long now) {
        String group = AlarmGroup.of(mission, "");
        boolean shallRun =
                status != null && (status.state() == MissionState.STARTING || status.state() == MissionState.RUNNING);
        if (shallRun && !status.missing().isEmpty()) {
            List<Cause.Device> some = status.missing().stream()
                    .map(device -> new Cause.Device(device.id(), null))
                    .toList();
            Cause.Extent extent = new Cause.Extent(status.devices() - status.confirmed(), status.devices());
            String text = "mission %s: %s".formatted(mission, status.reason());
            alarms.report(Cause.ofMany(AlarmKind.MISSING_DEVICES, group, text, some, extent), null, now);
        } else {
            alarms.end(AlarmKind.MISSING_DEVICES, group, "its devices are up or were stopped", now);
        }
    }
}
