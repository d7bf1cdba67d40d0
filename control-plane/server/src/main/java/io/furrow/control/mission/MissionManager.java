package io.furrow.control.mission;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.BiFunction;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;

import io.furrow.control.domain.Domain;
import io.furrow.control.domain.DomainManager;
import io.furrow.control.health.DeviceHealth;
import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.CommandProcessor;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.RequestLog;
import io.furrow.control.manager.StateJson;
import io.furrow.control.manager.StatusProcessor;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.manager.Table;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;

/**
 * Answers {@code service.missionmanager}, keeps {@code service.missions}, {@code .missions.status}, {@code .templates} and {@code
 * .devices}, and reads {@code service.devices.status}, {@code .health} and {@code .connection}.
 */
public final class MissionManager {
    private static final String MISSIONS = "missions";
    private static final String STATUSES = "mission-statuses";
    private static final String DEVICES = "devices";
    private static final String LISTS = "mission-device-lists";
    private static final String ROLLOUTS = "mission-rollouts";
    private static final String TEMPLATES = "templates";
    private static final String VERSIONS = "template-versions";
    private static final ManagerTopic<MissionCommand> TOPIC = ManagerTopic.MISSION;

    private MissionManager() {}

    /** Stores of its own; whoever uses {@link #handler} needs them, and those of {@link DomainManager}. */
    public static List<String> stores() {
        return List.of(MISSIONS, STATUSES, LISTS, ROLLOUTS, DEVICES, TEMPLATES, VERSIONS);
    }

    /** Missions as they are in the stores of a processor. */
    public static MissionCommandHandler handler(
            ProcessorContext<?, ?> context, EventPublisher publisher, MissionSettings options) {
        Table<Domain> domains = DomainManager.domains(context);
        MissionTables tables = new MissionTables(
                StoreTable.of(context, MISSIONS, Mission.class),
                StoreTable.of(context, STATUSES, MissionStatus.class),
                StoreTable.of(context, LISTS, Function.identity(), Function.identity()),
                StoreTable.of(context, ROLLOUTS, PendingAssignment.class),
                StoreTable.of(context, DEVICES, DeviceState.class),
                StoreTable.of(context, TEMPLATES, MissionTemplate::toBytes, MissionManager::template),
                StoreTable.of(context, VERSIONS, TemplateStore.Versions.class));
        SharedStores farm =
                new SharedStores(domains::contains, DomainManager.sequence(context), DomainManager.quota(context));
        return new MissionCommandHandler(tables, farm, options, publisher);
    }

    /** Its stores and those of domains are there already. @param remembered how long ids of requests are */
    public static void add(StreamsBuilder builder, Duration remembered, MissionSettings options) {
        builder.addStateStore(RequestLog.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, EventPublisher, CommandHandler<MissionCommand>> opening =
                (context, publisher) -> new TimedMissionHandler(handler(context, publisher, options));
        BiFunction<ProcessorContext<?, ?>, EventPublisher, StatusProcessor.StatusHandler> reports =
                (context, publisher) -> {
                    MissionCommandHandler handler = handler(context, publisher, options);
                    return (key, value, now) -> handler.reported(key, DeviceStatus.read(value), now);
                };
        BiFunction<ProcessorContext<?, ?>, EventPublisher, StatusProcessor.StatusHandler> healths =
                (context, publisher) -> {
                    MissionCommandHandler handler = handler(context, publisher, options);
                    return (key, value, now) ->
                            handler.reported(key, StateJson.readRecord(value, DeviceHealth.class), now);
                };
        BiFunction<ProcessorContext<?, ?>, EventPublisher, StatusProcessor.StatusHandler> connections =
                (context, publisher) -> {
                    MissionCommandHandler handler = handler(context, publisher, options);
                    return (key, value, now) -> handler.reported(key, DeviceConnection.read(value), now);
                };

        OutputRecord.send(
                ManagerInput.requests(builder, TOPIC)
                        .process(
                                () -> new CommandProcessor<>(TOPIC, remembered, opening),
                                Named.as("answer-mission-requests"),
                                storesWith(TOPIC.answers())),
                "missions-out");

        OutputRecord.send(
                ManagerInput.statuses(builder, Topics.DEVICES_STATUS, "device-statuses")
                        .process(() -> new StatusProcessor(reports), Named.as("take-device-statuses"), storesWith()),
                "progress-out");

        OutputRecord.send(
                ManagerInput.statuses(builder, Topics.DEVICES_HEALTH, "device-healths")
                        .process(() -> new StatusProcessor(healths), Named.as("take-device-healths"), storesWith()),
                "first-reports-out");

        OutputRecord.send(
                ManagerInput.statuses(builder, Topics.DEVICES_CONNECTION, "device-connections")
                        .process(
                                () -> new StatusProcessor(connections),
                                Named.as("take-device-connections"),
                                storesWith()),
                "silences-out");
    }

    private static String[] storesWith(String... further) {
        return Stream.of(DomainManager.stores(), stores(), List.of(further))
                .flatMap(List::stream)
                .toArray(String[]::new);
    }

    private static MissionTemplate template(byte[] value) {
        try {
            return MissionTemplate.read(value);
        } catch (RejectedException e) {
            throw new IllegalStateException(
                    "a stored template cannot be read: " + new String(value, StandardCharsets.UTF_8), e);
        }
    }

    /** Missions as time passes; the packaged template is there from the start. */
    private record TimedMissionHandler(MissionCommandHandler missions) implements CommandHandler<MissionCommand> {
        @Override
        public CommandResult answer(MissionCommand command, long now) throws RejectedException {
            return missions.answer(command, now);
        }

        @Override
        public List<Runnable> due(long now) {
            List<Runnable> steps = new ArrayList<>(missions.due(now));
            steps.add(0, missions.templates()::installBuiltIn);
            return steps;
        }

        @Override
        public List<Runnable> pending(long now) {
            return missions.pending(now);
        }
    }
}
