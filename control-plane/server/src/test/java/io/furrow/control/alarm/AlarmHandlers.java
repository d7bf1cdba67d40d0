package io.furrow.control.alarm;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.MapRecords;
import io.furrow.control.manager.Sequence;

/** Alarms without Kafka. */
public final class AlarmHandlers {
    private AlarmHandlers() {}

    public static AlarmCommandHandler writingTo(EventPublisher outbox) {
        return new AlarmCommandHandler(
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
