package io.furrow.control.replay;

import java.time.Duration;
import java.util.UUID;
import java.util.function.BiFunction;
import java.util.function.Supplier;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.CommandProcessor;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.GlobalStoreProcessor;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.RequestLog;
import io.furrow.control.manager.StatusProcessor;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.manager.Table;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Answers {@code service.replaymanager}, keeps {@code service.replays}, reads {@code service.replays.status} and {@code service.recordings}. */
public final class ReplayManager {
    private static final String REPLAYS = "replays";
    private static final String REPORTS = "replay-reports";
    private static final String SEQUENCE = "replay-sequence";
    private static final String RECORDINGS = "recordings";
    private static final ManagerTopic<ReplayCommand> TOPIC = ManagerTopic.REPLAY;

    private static final Logger LOG = LoggerFactory.getLogger(ReplayManager.class);

    private ReplayManager() {}

    /**
     * @param remembered how long ids of requests are
     * @param ids of new replays
     */
    public static void add(StreamsBuilder builder, Duration remembered, Supplier<UUID> ids, ReplaySettings settings) {
        builder.addGlobalStore(
                StoreTable.builder(RECORDINGS).withLoggingDisabled(),
                Topics.RECORDINGS,
                Consumed.with(Serdes.String(), Serdes.ByteArray()).withName("recordings-in"),
                () -> new GlobalStoreProcessor(RECORDINGS));
        builder.addStateStore(StoreTable.builder(REPLAYS));
        builder.addStateStore(StoreTable.builder(REPORTS));
        builder.addStateStore(StoreTable.builder(SEQUENCE));
        builder.addStateStore(RequestLog.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, EventPublisher, CommandHandler<ReplayCommand>> opening =
                (context, publisher) -> handler(context, publisher, ids, settings);
        BiFunction<ProcessorContext<?, ?>, EventPublisher, StatusProcessor.StatusHandler> reports =
                (context, publisher) -> {
                    ReplayCommandHandler handler = handler(context, publisher, ids, settings);
                    return (key, value, now) -> handler.reported(key, ReplayStatus.read(value), now);
                };

        OutputRecord.send(
                ManagerInput.requests(builder, TOPIC)
                        .process(
                                () -> new CommandProcessor<>(TOPIC, remembered, opening),
                                Named.as("answer-replay-requests"),
                                REPLAYS,
                                REPORTS,
                                SEQUENCE,
                                TOPIC.answers()),
                "replays-out");

        OutputRecord.send(
                ManagerInput.statuses(builder, Topics.REPLAYS_STATUS, "replay-statuses")
                        .process(
                                () -> new StatusProcessor(reports),
                                Named.as("take-replay-statuses"),
                                REPLAYS,
                                REPORTS,
                                SEQUENCE),
                "ended-replays-out");
    }

    /** Null of what is no record of a mission. */
    private static RecordedMission listed(byte[] value) {
        try {
            return RecordedMission.read(value);
        } catch (UnreadableException e) {
            LOG.debug("a record of {} cannot be read", Topics.RECORDINGS, e);
            return null;
        }
    }

    private static DesiredReplay stored(byte[] value) {
        try {
            return DesiredReplay.read(value);
        } catch (UnreadableException e) {
            throw new IllegalStateException("the manager kept a replay that it cannot read", e);
        }
    }

    private static ReplayCommandHandler handler(
            ProcessorContext<?, ?> context, EventPublisher publisher, Supplier<UUID> ids, ReplaySettings settings) {
        Table<RecordedMission> recordings =
                StoreTable.of(context, RECORDINGS, RecordedMission::toBytes, ReplayManager::listed);
        ReplayCommandHandler.ReplayStores stores = new ReplayCommandHandler.ReplayStores(
                StoreTable.of(context, REPLAYS, DesiredReplay::toBytes, ReplayManager::stored),
                StoreTable.of(context, REPORTS, ReportedReplay.class),
                StoreTable.of(context, SEQUENCE, Long.class));
        return new ReplayCommandHandler(
                stores, new RecordedMissions(settings.hasRecordings(), recordings::get), ids, settings, publisher);
    }
}
