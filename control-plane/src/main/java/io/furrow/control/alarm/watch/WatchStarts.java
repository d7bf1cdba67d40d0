package io.furrow.control.alarm.watch;

import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.Collectors;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.control.mission.MissionState;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.control.AlarmKind;

/** Raises an alarm while devices of a mission that starts or runs are missing, as its status says. */
final class WatchStarts {
    private static final int MAX_CAUSES = 3;

    private final AlarmCommandHandler alarms;
    private final Function<String, Optional<String>> causes;

    /** @param causes why a device is not heard, by its id */
    WatchStarts(AlarmCommandHandler alarms, Function<String, Optional<String>> causes) {
        this.alarms = alarms;
        this.causes = causes;
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
            String why = some.stream()
                    .flatMap(device -> causes.apply(device.id()).map(cause -> device.id() + ": " + cause).stream())
                    .limit(MAX_CAUSES)
                    .collect(Collectors.joining("; "));
            String text = "mission %s: %s%s".formatted(mission, status.reason(), why.isEmpty() ? "" : " (" + why + ")");
            alarms.report(Cause.ofMany(AlarmKind.MISSING_DEVICES, group, text, some, extent), null, now);
        } else {
            alarms.end(AlarmKind.MISSING_DEVICES, group, "its devices are up or were stopped", now);
        }
    }
}
