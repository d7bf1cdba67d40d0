package io.furrow.control.domain;

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
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Records;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StoreRecords;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.Limits;

/**
 * Answers {@code service.domainmanager} and keeps {@code service.domains}. It shares its stores with the manager of missions, in one
 * task: so no mission begins in a domain while that is deleted.
 */
public final class DomainManager {
    private static final String DOMAINS = "domains";
    private static final String SEQUENCE = "farm-sequence";
    private static final ManagerTopic<DomainCommand> TOPIC = ManagerTopic.DOMAIN;

    private DomainManager() {}

    /** Domains as they are in the stores of a processor. */
    public static DomainDesk desk(ProcessorContext<?, ?> context, DomainMissions missions, Outbox outbox) {
        return new DomainDesk(
                domains(context), missions, new DomainDesk.Means(sequence(context), quota(context)), outbox);
    }

    /** Stores that others may use. */
    public static List<String> stores() {
        return List.of(DOMAINS, SEQUENCE);
    }

    /** What there is of domains, for a processor that has {@link #stores()}. */
    public static Records<Domain> domains(ProcessorContext<?, ?> context) {
        return StoreRecords.of(context, DOMAINS, Domain.class);
    }

    /** The one sequence of what is wanted of domains, missions and devices. */
    public static Sequence sequence(ProcessorContext<?, ?> context) {
        return new Sequence(StoreRecords.of(context, SEQUENCE, Long.class));
    }

    /** Room for all definitions of domains, missions and templates together. */
    public static Quota quota(ProcessorContext<?, ?> context) {
        return new Quota(StoreRecords.of(context, SEQUENCE, Long.class), Limits.DEFINITIONS_BYTES);
    }

    /**
     * @param remembered how long ids of requests are
     * @param missions makes what stops missions, which needs further stores; these and {@link #stores()} are there already
     */
    public static void add(
            StreamsBuilder builder,
            Duration remembered,
            BiFunction<ProcessorContext<?, ?>, Outbox, DomainMissions> missions,
            List<String> storesOfMissions) {
        builder.addStateStore(AnsweredRequests.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, Outbox, Desk<DomainCommand>> opening =
                (context, outbox) -> desk(context, missions.apply(context, outbox), outbox)::answer;
        String[] stores = Stream.of(stores(), storesOfMissions, List.of(TOPIC.answers()))
                .flatMap(List::stream)
                .toArray(String[]::new);

        Outgoing.send(
                Inlet.requests(builder, TOPIC)
                        .process(
                                () -> new AnswerRequests<>(TOPIC, remembered, opening),
                                Named.as("answer-domain-requests"),
                                stores),
                "domains-out");
    }
}
