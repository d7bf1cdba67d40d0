package io.furrow.control.alarm.watch;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.Observer;
import io.furrow.control.manager.Table;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.time.Elapsed;

/**
 * Raises an alarm for a sensor that was excluded in three consecutive windows, because a single window may exclude a
 * sound sensor by chance. The alarm ends when the sensor was not excluded for three windows.
 */
final class SensorAlarmProcessor implements Observer {
    private static final int WINDOWS = 3;
    private static final Duration MIN = Duration.ofMinutes(1);
    /** Streaks of a field without windows for this time are discarded. */
    private static final Duration MAX_IDLE = Duration.ofDays(1);

    /** A window may end this much later than the clock, because devices have clocks too. */
    private static final Duration MAX_AHEAD = Duration.ofMinutes(1);

    private static final long CLEARING_INTERVAL = Duration.ofHours(1).toMillis();

    private final AlarmCommandHandler alarms;
    private final Function<String, String> types;
    private final Table<SuspectStreaks> streaks;
    private long cleared;

    SensorAlarmProcessor(AlarmCommandHandler alarms, Function<String, String> types, Table<SuspectStreaks> streaks) {
        this.alarms = alarms;
        this.types = types;
        this.streaks = streaks;
    }

    @Override
    public void take(Record<String, byte[]> record, long now) throws UnreadableException {
        FieldWindow window = record.value() == null ? null : FieldWindow.of(Entity.parse(record.value()));
        if (window == null) {
            return;
        }
        FiwareScope scope = KafkaClients.scope(record.headers());
        SuspectStreaks existing = streaksOf(scope.identity(window.field()), window.windowEnd(), now);
        SuspectStreaks streak = existing.after(window);
        if (streak == existing) {
            return;
        }
        streaks.put(streak.field(), streak); // also without suspects, because a late, earlier window must not count
        Duration validity = Duration.ofMillis((window.windowEnd() - window.windowStart()) * WINDOWS);
        for (FieldWindow.Suspect suspect : window.suspects()) {
            String id = suspect.id();
            String identity = scope.identity(suspect.type(), id);
            if (streak.of(suspect) >= WINDOWS || alarms.isRaised(AlarmKind.SUSPECT_SENSOR, identity)) {
                String text = "%s deviates from the other sensors in field %s".formatted(id, window.field());
                String type = suspect.type().isEmpty() ? types.apply(scope.identity(id)) : suspect.type();
                Cause.AffectedDevice device = Cause.AffectedDevice.of(id, type, scope);
                Duration atLeast = validity.compareTo(MIN) < 0 ? MIN : validity;
                Cause cause =
                        new Cause(AlarmKind.SUSPECT_SENSOR, id, text, List.of(device), atLeast).identifiedBy(identity);
                alarms.raise(cause.inGroup(AlarmGroup.ofField(window.field())), now);
            }
        }
    }

    /** Removes the streaks of fields that no longer produce windows. */
    @Override
    public void passTime(long now) {
        if (!Elapsed.hasPassed(CLEARING_INTERVAL, cleared, now)) {
            return;
        }
        cleared = now;
        streaks.where(streak -> streak.windowEnd() + MAX_IDLE.toMillis() <= now)
                .forEach(streak -> streaks.put(streak.field(), null));
    }

    /** Also discards streaks of when the clock was ahead: all later windows would count as late. */
    private SuspectStreaks streaksOf(String field, long time, long now) {
        SuspectStreaks existing = streaks.get(field);
        return existing == null
                        || existing.windowEnd() + MAX_IDLE.toMillis() <= time
                        || existing.windowEnd() > now + MAX_AHEAD.toMillis()
                ? new SuspectStreaks(field, Long.MIN_VALUE, Map.of())
                : existing;
    }
}
