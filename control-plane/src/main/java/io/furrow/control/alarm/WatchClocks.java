package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.function.Function;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Makes alarms of devices whose positions come too late to count, so that no analysis sees them. A job tells of one once a minute: it
 * is over when none has for three.
 */
public final class WatchClocks {
    private static final String BEHIND = "Analytics:ClockBehind";
    private static final Duration HOLDS = Duration.ofMinutes(3);

    private final AlarmDesk alarms;
    private final Function<String, String> types;

    WatchClocks(AlarmDesk alarms, Function<String, String> types) {
        this.alarms = alarms;
        this.types = types;
    }

    /**
     * @param now epoch ms
     * @throws UnreadableException where the record is no entity or tells of no device
     */
    public void take(byte[] record, FiwareScope scope, long now) throws UnreadableException {
        Entity entity = Entity.parse(record);
        if (!entity.type().equals(BEHIND)) {
            return;
        }
        String device = entity.text("device")
                .orElseThrow(
                        () -> new UnreadableException(Reason.NOT_AN_EVENT, "the report has no attribute 'device'"));
        String text = String.format(
                Locale.ROOT,
                "positions of %s come %.1f s too late and do not count: its clock or its link is behind",
                device,
                entity.number("late").orElse(0.0) / 1000);
        List<Cause.Device> devices = List.of(new Cause.Device(device, types.apply(scope.identity(device))));
        Cause cause = new Cause(AlarmKind.CLOCK_BEHIND, device, text, devices, HOLDS);
        alarms.raise(cause.inGroup(AlarmGroup.of(entity.text("Mission").orElse(""), "")), now);
    }
}
