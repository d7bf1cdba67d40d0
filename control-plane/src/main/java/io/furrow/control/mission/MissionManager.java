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
import io.furrow.control.manager.AnswerRequests;
import io.furrow.control.manager.AnsweredRequests;
import io.furrow.control.manager.Desk;
import io.furrow.control.manager.Inlet;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Outgoing;
import io.furrow.control.manager.Records;
import io.furrow.control.manager.StoreRecords;
import io.furrow.control.manager.TakeStatus;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.Response;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;

/**
 * Answers {@code service.missionmanager}, keeps {@code service.missions}, {@code .missions.status}, {@code .templates} and {@code
 * .devices}, and reads {@code service.devices.status}.
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

    /** Stores of its own; whoever uses {@link #desk} needs them, and those of {@link DomainManager}. */
    public static List<String> stores() {
        return List.of(MISSIONS, STATUSES, LISTS, ROLLOUTS, DEVICES, TEMPLATES, VERSIONS);
    }

    /** Missions as they are in the stores of a processor. */
    public static MissionDesk desk(ProcessorContext<?, ?> context, Outbox outbox, MissionOptions options) {
        Records<Domain> domains = DomainManager.domains(context);
        MissionRecords records = new MissionRecords(
                StoreRecords.of(context, MISSIONS, Mission.class),
                StoreRecords.of(context, STATUSES, MissionStatus.class),
                StoreRecords.of(context, LISTS, Function.identity(), Function.identity()),
                StoreRecords.of(context, ROLLOUTS, Rollout.class),
                StoreRecords.of(context, DEVICES, DeviceState.class),
                StoreRecords.of(context, TEMPLATES, MissionTemplate::toBytes, MissionManager::template),
                StoreRecords.of(context, VERSIONS, TemplateShelf.Versions.class));
        FarmContext farm =
                new FarmContext(domains::contains, DomainManager.sequence(context), DomainManager.quota(context));
        return new MissionDesk(records, farm, options, outbox);
    }

    /** Its stores and those of domains are there already. @param remembered how long ids of requests are */
    public static void add(StreamsBuilder builder, Duration remembered, MissionOptions options) {
        builder.addStateStore(AnsweredRequests.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, Outbox, Desk<MissionCommand>> opening =
                (context, outbox) -> new InTime(desk(context, outbox, options));
        BiFunction<ProcessorContext<?, ?>, Outbox, TakeStatus.Reports> reports = (context, outbox) -> {
            MissionDesk desk = desk(context, outbox, options);
            return (key, value, now) -> desk.reported(key, DeviceStatus.read(value), now);
        };

        Outgoing.send(
                Inlet.requests(builder, TOPIC)
                        .process(
                                () -> new AnswerRequests<>(TOPIC, remembered, opening),
                                Named.as("answer-mission-requests"),
                                storesWith(TOPIC.answers())),
                "missions-out");

        Outgoing.send(
                Inlet.statuses(builder, Topics.DEVICES_STATUS, "device-statuses")
                        .process(() -> new TakeStatus(reports), Named.as("take-device-statuses"), storesWith()),
                "progress-out");
    }

    private static String[] storesWith(String... further) {
        return Stream.of(DomainManager.stores(), stores(), List.of(further))
                .flatMap(List::stream)
                .toArray(String[]::new);
    }

    private static MissionTemplate template(byte[] value) {
        try {
            return MissionTemplate.read(value);
        } catch (RefusedException e) {
            throw new IllegalStateException(
                    "the remembered template is none: " + new String(value, StandardCharsets.UTF_8), e);
        }
    }

    /** Missions as time passes; the packaged template is there from the start. */
    private record InTime(MissionDesk missions) implements Desk<MissionCommand> {
        @Override
        public Response answer(MissionCommand command, long now) throws RefusedException {
            return missions.answer(command, now);
        }

        @Override
        public List<Runnable> due(long now) {
            List<Runnable> steps = new ArrayList<>(missions.due(now));
            steps.add(0, missions.templates()::stock);
            return steps;
        }

        @Override
        public List<Runnable> pending(long now) {
            return missions.pending(now);
        }
    }
}
