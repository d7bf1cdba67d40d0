package io.furrow.control.alarm.watch;

import java.time.Duration;
import java.util.List;
import java.util.function.BiFunction;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmManager;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.ObserverProcessor;
import io.furrow.control.manager.ObserverProcessor.Observer;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.RecordScope;
import io.furrow.control.manager.StoreTable;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.Fault;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/** Adds the processors that raise alarms from results of analytics, from the statuses of missions and from faults of Furrow itself. */
public final class AnalyticsAlarms {
    /** Three times the interval at which it is repeated. */
    private static final Duration FAULT_HOLDS = Duration.ofMinutes(3);

    private AnalyticsAlarms() {}

    /**
     * Lookup of device types by tenant, service path and entity id.
     *
     * @param opening creates the lookup function
     * @param stores names of the stores that it needs
     */
    public record Types(Function<ProcessorContext<?, ?>, Function<String, String>> opening, List<String> stores) {}

    /** @param collisions the records of {@code data.collision}, in a single partition */
    public static void addEncounters(
            KStream<String, byte[]> collisions, Types types, EncounterAlarmProcessor.AlarmDurations holds) {
        BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening = (context, publisher) -> {
            EncounterAlarmProcessor watch = new EncounterAlarmProcessor(
                    AlarmManager.handler(context, publisher), types.opening().apply(context), holds);
            return (record, now) -> {
                if (record.value() != null) {
                    watch.take(EncounterReport.read(record.value(), RecordScope.of(record)), now);
                }
            };
        };
        send(collisions, opening, types, "encounters");
    }

    /** @param temperatures the records of {@code data.temperature}, in a single partition */
    public static void addSensors(StreamsBuilder builder, KStream<String, byte[]> temperatures, Types types) {
        builder.addStateStore(StoreTable.builder(SensorAlarmProcessor.RUNS));
        BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening = (context, publisher) -> {
            SensorAlarmProcessor watch = new SensorAlarmProcessor(
                    AlarmManager.handler(context, publisher),
                    types.opening().apply(context),
                    StoreTable.of(context, SensorAlarmProcessor.RUNS, SuspectStreaks.class));
            return new SensorObserver(watch);
        };
        send(temperatures, opening, types, "sensors", SensorAlarmProcessor.RUNS);
    }

    /** @param clocks the records of {@code data.clocks}, in a single partition */
    public static void addClocks(KStream<String, byte[]> clocks, Types types) {
        BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening = (context, publisher) -> {
            ClockAlarmProcessor watch = new ClockAlarmProcessor(
                    AlarmManager.handler(context, publisher), types.opening().apply(context));
            return (record, now) -> {
                if (record.value() != null) {
                    watch.take(record.value(), RecordScope.of(record), now);
                }
            };
        };
        send(clocks, opening, types, "clocks");
    }

    /** @param faults the records of {@code service.faults}, in a single partition */
    public static void addFaults(KStream<String, byte[]> faults, Types types) {
        BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening = (context, publisher) -> {
            AlarmCommandHandler alarms = AlarmManager.handler(context, publisher);
            return (record, now) -> {
                if (record.key() != null && record.value() != null) {
                    String text = Fault.read(record.value()).text();
                    alarms.raiseReworded(new Cause(AlarmKind.FAULT, record.key(), text, List.of(), FAULT_HOLDS), now);
                }
            };
        };
        send(faults, opening, types, "faults");
    }

    /** @param statuses the records of {@code service.missions.status}, in a single partition */
    public static void addStarts(KStream<String, byte[]> statuses, Types types) {
        send(
                statuses,
                (context, publisher) -> new StartAlarmProcessor(AlarmManager.handler(context, publisher)),
                types,
                "starts");
    }

    private record SensorObserver(SensorAlarmProcessor watch) implements Observer {
        @Override
        public void take(Record<String, byte[]> record, long now) throws UnreadableException {
            FieldWindow window = record.value() == null ? null : FieldWindow.of(Entity.parse(record.value()));
            if (window != null) {
                watch.take(window, RecordScope.of(record), now);
            }
        }

        @Override
        public void passTime(long now) {
            watch.passTime(now);
        }
    }

    private static void send(
            KStream<String, byte[]> results,
            BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening,
            Types types,
            String name,
            String... own) {
        String[] stores = Stream.of(AlarmManager.stores(), types.stores(), List.of(own))
                .flatMap(List::stream)
                .toArray(String[]::new);
        OutputRecord.send(
                results.process(() -> new ObserverProcessor(opening), Named.as("watch-" + name), stores),
                name + "-out");
    }
}
