package io.furrow.control.replay;

import java.time.Duration;
import java.util.UUID;
import java.util.function.BiFunction;
import java.util.function.Supplier;

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
import io.furrow.control.manager.StoreRecords;
import io.furrow.control.manager.TakeStatus;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

/** Answers {@code service.replaymanager}, keeps {@code service.replays}, and reads {@code service.replays.status}. */
public final class ReplayManager {
    private static final String REPLAYS = "replays";
    private static final String SEQUENCE = "replay-sequence";
    private static final ManagerTopic<ReplayCommand> TOPIC = ManagerTopic.REPLAY;

    private ReplayManager() {}

    /**
     * @param remembered how long ids of requests are
     * @param ids of new replays
     */
    public static void add(StreamsBuilder builder, Duration remembered, Supplier<UUID> ids) {
        builder.addStateStore(StoreRecords.builder(REPLAYS));
        builder.addStateStore(StoreRecords.builder(SEQUENCE));
        builder.addStateStore(AnsweredRequests.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, Outbox, Desk<ReplayCommand>> opening =
                (context, outbox) -> desk(context, outbox, ids)::answer;
        BiFunction<ProcessorContext<?, ?>, Outbox, TakeStatus.Reports> reports = (context, outbox) -> {
            ReplayDesk desk = desk(context, outbox, ids);
            return (key, value, now) -> desk.reported(key, ReplayStatus.read(value));
        };

        Outgoing.send(
                Inlet.requests(builder, TOPIC)
                        .process(
                                () -> new AnswerRequests<>(TOPIC, remembered, opening),
                                Named.as("answer-replay-requests"),
                                REPLAYS,
                                SEQUENCE,
                                TOPIC.answers()),
                "replays-out");

        Outgoing.send(
                Inlet.statuses(builder, Topics.REPLAYS_STATUS, "replay-statuses")
                        .process(() -> new TakeStatus(reports), Named.as("take-replay-statuses"), REPLAYS, SEQUENCE),
                "ended-replays-out");
    }

    private static ReplayDesk desk(ProcessorContext<?, ?> context, Outbox outbox, Supplier<UUID> ids) {
        return new ReplayDesk(
                StoreRecords.of(context, REPLAYS, Replay.class),
                StoreRecords.of(context, SEQUENCE, Long.class),
                ids,
                outbox);
    }
}
