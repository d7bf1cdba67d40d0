package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;

import io.furrow.control.manager.CapturingPublisher;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.MapTable;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.topic.Topics;

/** Runs the alarm handler without Kafka. */
public class AlarmHandlerFixture {
    static final long NOW = 1_700_000_000_000L;
    static final Duration HOUR = Duration.ofHours(1);

    final MapTable<AlarmTables.Mute> mutes = MapTable.of(AlarmTables.Mute.class);
    final CapturingPublisher publisher = new CapturingPublisher();
    final AlarmCommandHandler handler = handler(mutes, publisher);

    public static AlarmCommandHandler writingTo(EventPublisher publisher) {
        return handler(MapTable.of(AlarmTables.Mute.class), publisher);
    }

    private static AlarmCommandHandler handler(MapTable<AlarmTables.Mute> mutes, EventPublisher publisher) {
        return new AlarmCommandHandler(
                new AlarmTables(
                        MapTable.of(Alarm.class),
                        MapTable.of(String.class),
                        mutes,
                        MapTable.of(AlarmLimit.Group.class),
                        MapTable.of(AlarmLimit.Overflow.class)),
                new Sequence(MapTable.of(Long.class)),
                publisher);
    }

    static Cause silent(String device) {
        return new Cause(
                AlarmKind.SILENT_DEVICE,
                device,
                "it is silent",
                List.of(new Cause.AffectedDevice(device, "Thermometer", null, null)),
                null);
    }

    List<Alarm> current() {
        return publisher.compacted(Topics.ALARMS).values().stream()
                .map(json -> StateJson.read(json, Alarm.class))
                .filter(alarm -> alarm.state() != AlarmState.CLOSED)
                .toList();
    }

    Alarm alarm(String id) {
        return StateJson.read(publisher.compacted(Topics.ALARMS).get(id), Alarm.class);
    }
}
