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
import io.furrow.model.ngsi.UnreadableException;

/**
 * Raises alarms for encounters. A collision lasts until some time after the end of the encounter, so that devices near
 * the distance threshold have one alarm, not one per report. Records of an ongoing encounter raise it too, if it was
 * closed manually or began before the processor started. The end of a prediction is not reported: it ends when it is
 * not repeated for a while, or when the encounter starts; a pair with a collision has no prediction. A collision that
 * is not repeated for {@link AlarmCommandHandler#COLLISION_VALIDITY} ends too, because its last record was lost.
 *
 * @param types returns the type of a device's entity by tenant, service path and id
 */
public record EncounterAlarmProcessor(
        AlarmCommandHandler alarms, Function<String, String> types, AlarmDurations durations) implements Observer {
    private static final String METERS = "meters";

    /**
     * How long alarms last without a record of their encounter.
     *
     * @param prediction how long a prediction stays valid without being repeated
     * @param collision how long a collision lasts after the end of its encounter
     */
    public record AlarmDurations(Duration prediction, Duration collision) {}

    @Override
    public void take(Record<String, byte[]> record, long now) throws UnreadableException {
        if (record.value() == null) {
            return;
        }
        EncounterReport encounter = EncounterReport.read(record.value(), KafkaClients.scope(record.headers()));
        String pair = encounter.identity();
        switch (encounter.phase()) {
            case "started" -> {
                alarms.end(AlarmKind.PREDICTED_ENCOUNTER, pair, "the encounter has started", now);
                alarms.raiseAgain(cause(AlarmKind.COLLISION, encounter, AlarmCommandHandler.COLLISION_VALIDITY), now);
            }
            case "ongoing" ->
                alarms.raiseOrExtend(
                        cause(AlarmKind.COLLISION, encounter, AlarmCommandHandler.COLLISION_VALIDITY), now);
            case "ended" -> {
                alarms.lower(cause(AlarmKind.COLLISION, encounter, AlarmCommandHandler.COLLISION_VALIDITY), METERS);
                alarms.endAt(
                        AlarmKind.COLLISION, pair, now + durations.collision().toMillis());
            }
            case "predicted" -> {
                if (!alarms.isRaised(AlarmKind.COLLISION, pair)) {
                    alarms.raise(cause(AlarmKind.PREDICTED_ENCOUNTER, encounter, durations.prediction()), now);
                }
            }
            default -> {} // other phases neither raise nor end an alarm
        }
    }

    private Cause cause(AlarmKind kind, EncounterReport encounter, Duration validity) {
        String text =
                kind == AlarmKind.COLLISION ? "%s and %s came within %.1f m" : "%s and %s will come within %.1f m";
        List<Cause.AffectedDevice> devices = encounter.members().stream()
                .map(member -> Cause.AffectedDevice.of(member.id(), member.type(types), member.scope()))
                .toList();
        return new Cause(
                        kind,
                        encounter.pair(),
                        String.format(
                                Locale.ROOT,
                                text,
                                encounter.first().id(),
                                encounter.second().id(),
                                encounter.meters()),
                        devices,
                        validity)
                .withValue(METERS, encounter.meters())
                .identifiedBy(encounter.identity())
                .inGroup(AlarmGroup.of(encounter.mission(), ""));
    }
}
