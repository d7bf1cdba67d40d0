package io.furrow.control.alarm.watch;

import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.function.Function;

import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.Observer;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.result.ClockResult;

/**
 * Raises alarms for devices whose reports arrive too late and are dropped by all analyses. A report names the
 * interval to the next one; the alarm ends after four intervals, at least three minutes, without a report. Four: a job that was
 * restarted reports a device after three of its records.
 */
record ClockAlarmProcessor(AlarmCommandHandler alarms, Function<String, String> types) implements Observer {
    private static final Duration MIN_VALIDITY = Duration.ofMinutes(3);
    private static final int INTERVALS = 4;

    @Override
    public void take(Record<String, byte[]> record, long now) throws UnreadableException {
        if (record.value() == null) {
            return;
        }
        FiwareScope scope = KafkaClients.scope(record.headers());
        Entity entity = Entity.parse(record.value());
        if (!entity.type().equals(ClockResult.BEHIND_TYPE)) {
            return;
        }
        String device = entity.text(ClockResult.DEVICE)
                .orElseThrow(
                        () -> new UnreadableException(Reason.NOT_AN_EVENT, "the report has no attribute 'device'"));
        double late = entity.number(ClockResult.LATE).orElse(0.0) / 1000;
        String text = String.format(
                Locale.ROOT,
                "%s of %s arrive %s too late and are dropped: check its clock and its link",
                entity.number(ClockResult.REPORTS).isPresent() ? ClockResult.REPORTS : "positions",
                device,
                delay(late));
        String type = entity.text(ClockResult.DEVICE_TYPE).orElse("");
        String existing = type.isEmpty() ? types.apply(scope.identity(device)) : type;
        List<Cause.AffectedDevice> devices = List.of(Cause.AffectedDevice.of(device, existing, scope));
        Cause cause = new Cause(AlarmKind.CLOCK_BEHIND, device, text, devices, validity(entity))
                .identifiedBy(scope.identity(type, device))
                .withValue("late", late);
        alarms.raise(cause.inGroup(AlarmGroup.of(entity.text("Mission").orElse(""), "")), now);
    }

    private static String delay(double seconds) {
        Duration delay = Duration.ofSeconds((long) seconds);
        if (delay.toMinutes() < 2) {
            return String.format(Locale.ROOT, "%.1f s", seconds);
        } else if (delay.toHours() < 2) {
            return delay.toMinutes() + " min";
        }
        return delay.toDays() < 2 ? delay.toHours() + " h" : delay.toDays() + " days";
    }

    private static Duration validity(Entity report) {
        double millis = INTERVALS * report.number(ClockResult.INTERVAL).orElse(0.0);
        return Duration.ofMillis(Math.max(MIN_VALIDITY.toMillis(), (long) millis));
    }
}
