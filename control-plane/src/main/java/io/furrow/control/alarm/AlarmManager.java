package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.function.BiFunction;
import java.util.stream.Stream;

import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;

import io.furrow.control.manager.AnswerRequests;
import io.furrow.control.manager.AnsweredRequests;
import io.furrow.control.manager.Desk;
import io.furrow.control.manager.Inlet;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Outgoing;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StoreRecords;
import io.furrow.model.control.AlarmCommand;

/** Answers {@code service.alarmmanager} and keeps {@code service.alarms}. Whatever raises alarms shares its stores, in one task. */
public final class AlarmManager {
    private static final String ALARMS = "alarms";
    private static final String CURRENT = "current-alarms";
    private static final String MUTES = "alarm-mutes";
    private static final String SEQUENCE = "alarm-sequence";
    private static final String GROUPS = "alarm-groups";
    private static final String COUNTED = "alarm-counted";
    private static final ManagerTopic<AlarmCommand> TOPIC = ManagerTopic.ALARM;

    private AlarmManager() {}

    /** Stores that whoever uses {@link #desk} needs. */
    public static List<String> stores() {
        return List.of(ALARMS, CURRENT, MUTES, SEQUENCE, GROUPS, COUNTED);
    }

    /** Alarms as they are in the stores of a processor. */
    public static AlarmDesk desk(ProcessorContext<?, ?> context, Outbox outbox) {
        AlarmRecords records = new AlarmRecords(
                StoreRecords.of(context, ALARMS, Alarm.class),
                StoreRecords.of(context, CURRENT, String.class),
                StoreRecords.of(context, MUTES, AlarmRecords.Mute.class),
                StoreRecords.of(context, GROUPS, AlarmLimit.Group.class),
                StoreRecords.of(context, COUNTED, AlarmLimit.Counted.class));
        return new AlarmDesk(records, new Sequence(StoreRecords.of(context, SEQUENCE, Long.class)), outbox);
    }

    /** @param remembered how long ids of requests are */
    public static void add(StreamsBuilder builder, Duration remembered) {
        stores().forEach(store -> builder.addStateStore(StoreRecords.builder(store)));
        builder.addStateStore(AnsweredRequests.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, Outbox, Desk<AlarmCommand>> opening = AlarmManager::desk;
        String[] stores = Stream.of(stores(), List.of(TOPIC.answers()))
                .flatMap(List::stream)
                .toArray(String[]::new);

        Outgoing.send(
                Inlet.requests(builder, TOPIC)
                        .process(
                                () -> new AnswerRequests<>(TOPIC, remembered, opening),
                                Named.as("answer-alarm-requests"),
                                stores),
                "alarms-out");
    }
}
