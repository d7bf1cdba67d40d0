package io.furrow.control.alarm;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import io.furrow.control.manager.Records;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;

/**
 * Makes alarms of sensors that were set aside in three windows in a row: in one alone, chance sets a sound one aside now and then.
 * One is over when the sensor was not set aside for three windows.
 */
public final class WatchSensors {
    static final String RUNS = "suspect-runs";

    private static final int WINDOWS = 3;
    private static final Duration LEAST = Duration.ofMinutes(1);
    /** A field that has shown nothing for so long begins anew. */
    private static final Duration REMEMBERED = Duration.ofDays(1);

    private static final long CLEARING_EVERY = Duration.ofHours(1).toMillis();

    private final AlarmDesk alarms;
    private final Function<String, String> types;
    private final Records<SuspectRuns> runs;
    private long nextClearing;

    WatchSensors(AlarmDesk alarms, Function<String, String> types, Records<SuspectRuns> runs) {
        this.alarms = alarms;
        this.types = types;
        this.runs = runs;
    }

    /** @param now epoch ms */
    public void take(FieldWindow window, FiwareScope scope, long now) {
        SuspectRuns known = runsOf(scope.identity(window.field()), window.windowEnd());
        SuspectRuns run = known.after(window);
        if (run == known) {
            return;
        }
        runs.put(run.field(), run); // also without a suspect: what comes of an earlier window must not count
        Duration holds = Duration.ofMillis((window.windowEnd() - window.windowStart()) * WINDOWS);
        for (String suspect : window.suspects()) {
            if (run.of(suspect) >= WINDOWS || alarms.isRaised(AlarmKind.SUSPECT_SENSOR, suspect)) {
                String text = "%s shows what the others in field %s do not".formatted(suspect, window.field());
                Cause.Device device = new Cause.Device(suspect, types.apply(scope.identity(suspect)));
                Duration atLeast = holds.compareTo(LEAST) < 0 ? LEAST : holds;
                Cause cause = new Cause(AlarmKind.SUSPECT_SENSOR, suspect, text, List.of(device), atLeast);
                alarms.raise(cause.inGroup(AlarmGroup.ofField(window.field())), now);
            }
        }
    }

    /** Forgets the runs of fields that show nothing any more. */
    public void passTime(long now) {
        if (now < nextClearing) {
            return;
        }
        nextClearing = now + CLEARING_EVERY;
        List<String> passed = new ArrayList<>();
        runs.forEach(run -> {
            if (run.windowEnd() + REMEMBERED.toMillis() <= now) {
                passed.add(run.field());
            }
        });
        passed.forEach(field -> runs.put(field, null));
    }

    private SuspectRuns runsOf(String field, long time) {
        SuspectRuns known = runs.get(field);
        return known == null || known.windowEnd() + REMEMBERED.toMillis() <= time
                ? new SuspectRuns(field, Long.MIN_VALUE, Map.of())
                : known;
    }
}
