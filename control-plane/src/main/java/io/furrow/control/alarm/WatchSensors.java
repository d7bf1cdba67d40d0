package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.function.Function;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;

/** Makes alarms of sensors that were set aside. One is over when the sensor was not set aside for three windows. */
public final class WatchSensors {
    private static final int WINDOWS = 3;
    private static final Duration LEAST = Duration.ofMinutes(1);

    private final AlarmDesk alarms;
    private final Function<String, String> types;

    public WatchSensors(AlarmDesk alarms, Function<String, String> types) {
        this.alarms = alarms;
        this.types = types;
    }

    /** @param now epoch ms */
    public void take(FieldWindow window, FiwareScope scope, long now) {
        Duration holds = Duration.ofMillis((window.windowEnd() - window.windowStart()) * WINDOWS);
        for (String suspect : window.suspects()) {
            String text = "%s shows what the others in field %s do not".formatted(suspect, window.field());
            Cause.Device device = new Cause.Device(suspect, types.apply(scope.identity(suspect)));
            Duration atLeast = holds.compareTo(LEAST) < 0 ? LEAST : holds;
            Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, suspect, text, List.of(device), atLeast);
            alarms.raise(cause.inGroup(AlarmGroup.ofField(window.field())), now);
        }
    }
}
