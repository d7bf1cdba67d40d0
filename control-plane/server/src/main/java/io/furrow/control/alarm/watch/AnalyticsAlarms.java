package io.furrow.control.alarm.watch;

import java.time.Duration;
import java.util.List;
import java.util.function.BiFunction;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.streams.kstream.KStream;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmManager;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Observer;
import io.furrow.control.manager.UnitOfWork;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.Fault;
import io.furrow.model.event.FiwareScope;

/** Adds the processors that raise alarms from results of analytics, statuses of missions and faults of Furrow itself. */
public final class AnalyticsAlarms {
    /** Three times the interval at which faults are repeated. */
    private static final Duration FAULT_VALIDITY = Duration.ofMinutes(3);

    private AnalyticsAlarms() {}

    /**
     * Lookup of device types by tenant, service path and entity id.
     *
     * @param opening creates the lookup function
     * @param stores names of the stores that it needs
     */
    public record Types(Function<UnitOfWork, Function<String, String>> opening, List<String> stores) {
        private Function<String, String> of(UnitOfWork unit) {
            return opening.apply(unit);
        }
    }

    /** @param collisions the records of {@code data.collision}, in a single partition */
    public static void addEncounters(
            KStream<String, byte[]> collisions, Types types, EncounterAlarmProcessor.AlarmDurations durations) {
        add(
                collisions,
                "encounters",
                types,
                (alarms, unit) -> new EncounterAlarmProcessor(alarms, types.of(unit), durations));
    }

    /** @param temperatures the records of {@code data.temperature}, in a single partition */
    public static void addSensors(KStream<String, byte[]> temperatures, Types types) {
        add(
                temperatures,
                "sensors",
                types,
                (alarms, unit) -> new SensorAlarmProcessor(
                        alarms, types.of(unit), unit.table(AlarmManager.SUSPECTS, SuspectStreaks.class)));
    }

    /** @param clocks the records of {@code data.clocks}, in a single partition */
    public static void addClocks(KStream<String, byte[]> clocks, Types types) {
        add(clocks, "clocks", types, (alarms, unit) -> new ClockAlarmProcessor(alarms, types.of(unit)));
    }

    /** @param faults the records of {@code service.faults}, in a single partition */
    public static void addFaults(KStream<String, byte[]> faults, Types types) {
        add(faults, "faults", types, (alarms, unit) ->
                (Observer.OfStatuses) (key, value, now) -> alarms.raiseReworded(cause(key, Fault.read(value)), now));
    }

    private static Cause cause(String part, Fault fault) {
        List<Cause.Detail> details =
                fault.code() == null ? List.of() : List.of(new Cause.Detail(null, fault.code(), fault.values()));
        return new Cause(AlarmKind.FAULT, part, fault.text(), List.of(), FAULT_VALIDITY).withDetails(details);
    }

    /**
     * @param statuses the records of {@code service.missions.status}, in a single partition
     * @param scope of the devices of missions
     */
    public static void addStarts(KStream<String, byte[]> statuses, Types types, FiwareScope scope) {
        add(statuses, "starts", types, (alarms, unit) -> new StartAlarmProcessor(alarms, types.of(unit), scope));
    }

    private static void add(
            KStream<String, byte[]> results,
            String name,
            Types types,
            BiFunction<AlarmCommandHandler, UnitOfWork, Observer> opening) {
        ManagerTopology.observe(
                results,
                new ManagerTopology.Nodes("watch-" + name, name + "-out"),
                true,
                unitOfWork -> opening.apply(AlarmManager.handler(unitOfWork), unitOfWork),
                Stream.concat(AlarmManager.stores().stream(), types.stores().stream())
                        .toList());
    }
}
