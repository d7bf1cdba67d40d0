package io.furrow.control.alarm.watch;

import java.time.Duration;
import java.util.List;
import java.util.function.Function;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.model.control.AlarmKind;

/**
 * Raises alarms for encounters. A collision lasts until the encounter has ended; records of an ongoing encounter raise
 * it too, if it was closed manually or began before the processor started. No record reports the end of a prediction:
 * it ends when it is not repeated for a while, or when the encounter starts. A collision that is not repeated for {@link
 * #COLLISION_HOLDS} has ended, too: its last record was lost.
 */
public final class WatchEncounters {
    /** Many times the interval of the records of an ongoing encounter, which its devices' time-to-live limits. */
    static final Duration COLLISION_HOLDS = Duration.ofHours(1);

    private final AlarmCommandHandler alarms;
    private final Function<String, String> types;
    private final Duration predictionHolds;

    /**
     * @param types returns the type of a device's entity by tenant, service path and id
     * @param predictionHolds how long a prediction stays valid without being repeated
     */
    public WatchEncounters(AlarmCommandHandler alarms, Function<String, String> types, Duration predictionHolds) {
        this.alarms = alarms;
        this.types = types;
        this.predictionHolds = predictionHolds;
    }

    /** @param now epoch ms */
    public void take(Encounter encounter, long now) {
        String pair = encounter.pair();
        switch (encounter.phase()) {
            case "started" -> {
                alarms.end(AlarmKind.PREDICTED_ENCOUNTER, pair, "the encounter has started", now);
                alarms.raise(cause(AlarmKind.COLLISION, encounter, COLLISION_HOLDS), now);
            }
            case "ongoing" -> alarms.raise(cause(AlarmKind.COLLISION, encounter, COLLISION_HOLDS), now);
            case "ended" -> alarms.end(AlarmKind.COLLISION, pair, "the encounter has ended", now);
            case "predicted" -> alarms.raise(cause(AlarmKind.PREDICTED_ENCOUNTER, encounter, predictionHolds), now);
            default -> {} // other phases neither raise nor end an alarm
        }
    }

    private Cause cause(AlarmKind kind, Encounter encounter, Duration holds) {
        String text = kind == AlarmKind.COLLISION ? "%s and %s are %s apart" : "%s and %s will come within %s";
        List<Cause.Device> devices = encounter.members().stream()
                .map(member -> new Cause.Device(
                        member.id(), types.apply(encounter.scope().identity(member.id()))))
                .toList();
        return new Cause(
                        kind,
                        encounter.pair(),
                        text.formatted(
                                encounter.first().id(), encounter.second().id(), encounter.meters()),
                        devices,
                        holds)
                .inGroup(AlarmGroup.of(encounter.mission(), ""));
    }
}
