package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.function.BiFunction;
import java.util.stream.Stream;

import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;

import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.CommandProcessor;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.RequestLog;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StoreTable;
import io.furrow.model.control.AlarmCommand;

/**
 * Processes requests on {@code service.alarmmanager} and maintains {@code service.alarms}. All processors that raise
 * alarms share its stores, in one task.
 */
public final class AlarmManager {
    private static final String ALARMS = "alarms";
    private static final String CURRENT = "current-alarms";
    private static final String MUTES = "alarm-mutes";
    private static final String SEQUENCE = "alarm-sequence";
    private static final String GROUPS = "alarm-groups";
    private static final String COUNTED = "alarm-counted";
    private static final ManagerTopic<AlarmCommand> TOPIC = ManagerTopic.ALARM;

    private AlarmManager() {}

    /** Names of the stores that users of {@link #handler} need. */
    public static List<String> stores() {
        return List.of(ALARMS, CURRENT, MUTES, SEQUENCE, GROUPS, COUNTED);
    }

    /** Creates a handler on the stores of a processor. */
    public static AlarmCommandHandler handler(ProcessorContext<?, ?> context, EventPublisher publisher) {
        AlarmTables tables = new AlarmTables(
                StoreTable.of(context, ALARMS, Alarm.class),
                StoreTable.of(context, CURRENT, String.class),
                StoreTable.of(context, MUTES, AlarmTables.Mute.class),
                StoreTable.of(context, GROUPS, AlarmLimit.Group.class),
                StoreTable.of(context, COUNTED, AlarmLimit.Overflow.class));
        return new AlarmCommandHandler(tables, new Sequence(StoreTable.of(context, SEQUENCE, Long.class)), publisher);
    }

    /** @param remembered how long ids of requests are remembered */
    public static void add(StreamsBuilder builder, Duration remembered) {
        stores().forEach(store -> builder.addStateStore(StoreTable.builder(store)));
        builder.addStateStore(RequestLog.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, EventPublisher, CommandHandler<AlarmCommand>> opening =
                AlarmManager::handler;
        String[] stores = Stream.of(stores(), List.of(TOPIC.answers()))
                .flatMap(List::stream)
                .toArray(String[]::new);

        OutputRecord.send(
                ManagerInput.requests(builder, TOPIC)
                        .process(
                                () -> new CommandProcessor<>(TOPIC, remembered, opening),
                                Named.as("answer-alarm-requests"),
                                stores),
                "alarms-out");
    }
}
