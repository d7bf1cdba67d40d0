package io.furrow.control.alarm;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.MapTable;
import io.furrow.control.manager.Sequence;

/** Alarms without Kafka. */
public final class AlarmHandlerFixture {
    private AlarmHandlerFixture() {}

    public static AlarmCommandHandler writingTo(EventPublisher publisher) {
        return new AlarmCommandHandler(
                new AlarmTables(
                        MapTable.of(Alarm.class),
                        MapTable.of(String.class),
                        MapTable.of(AlarmTables.Mute.class),
                        MapTable.of(AlarmLimit.Group.class),
                        MapTable.of(AlarmLimit.Overflow.class)),
                new Sequence(MapTable.of(Long.class)),
                publisher);
    }
}
