package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.function.Function;

import io.furrow.model.control.AlarmKind;

/**
 * Makes alarms of encounters. A collision lasts until the encounter has ended; whatever says that it goes on raises it too, where it
 * was closed by hand or began before anybody watched. There is no record of the end of a prediction:
 * it is over when it is not told again for a while, or when it came true.
 */
public final class WatchEncounters {
    private final AlarmDesk alarms;
    private final Function<String, String> types;
    private final Duration predictionHolds;

    /**
     * @param types of what type the entity of a device is, by tenant, service path and id
     * @param predictionHolds how long a prediction is taken for right when it is not told again
     */
    public WatchEncounters(AlarmDesk alarms, Function<String, String> types, Duration predictionHolds) {
        this.alarms = alarms;
        this.types = types;
        this.predictionHolds = predictionHolds;
    }

    /** @param now epoch ms */
    public void take(Encounter encounter, long now) {
        String pair = encounter.pair();
        switch (encounter.phase()) {
            case "started" -> {
                alarms.end(AlarmKind.PREDICTED_ENCOUNTER, pair, "it came true", now);
                alarms.raise(cause(AlarmKind.COLLISION, encounter, null), now);
            }
            case "ongoing" -> alarms.raise(cause(AlarmKind.COLLISION, encounter, null), now);
            case "ended" -> alarms.end(AlarmKind.COLLISION, pair, "the encounter has ended", now);
            case "predicted" -> alarms.raise(cause(AlarmKind.PREDICTED_ENCOUNTER, encounter, predictionHolds), now);
            default -> {} // the others neither begin nor end anything
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
                                encounter.first().id(), encounter.second().id(), encounter.metres()),
                        devices,
                        holds)
                .inGroup(AlarmGroup.of(encounter.mission(), ""));
    }
}
