package io.furrow.control.alarm;

import io.furrow.control.manager.MapRecords;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Sequence;

/** Alarms without Kafka. */
public final class AlarmDesks {
    private AlarmDesks() {}

    public static AlarmDesk writingTo(Outbox outbox) {
        return new AlarmDesk(
                new AlarmRecords(
                        MapRecords.of(Alarm.class),
                        MapRecords.of(String.class),
                        MapRecords.of(AlarmRecords.Mute.class),
                        MapRecords.of(AlarmLimit.Group.class),
                        MapRecords.of(AlarmLimit.Counted.class)),
                new Sequence(MapRecords.of(Long.class)),
                outbox);
    }
}
