package io.furrow.control.domain;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.BiFunction;
import java.util.stream.Stream;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;

import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.CommandProcessor;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.GlobalStoreProcessor;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.RequestLog;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.manager.Table;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.Limits;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Processes requests on {@code service.domainmanager} and maintains {@code service.domains}. It shares its stores with
 * the mission manager, in one task, so that no mission starts in a domain while the domain is deleted.
 */
public final class DomainManager {
    private static final String DOMAINS = "domains";
    private static final String SEQUENCE = "farm-sequence";
    /** A global store, which processors need not name. */
    private static final String FIELDS = "fields";

    private static final ManagerTopic<DomainCommand> TOPIC = ManagerTopic.DOMAIN;

    private DomainManager() {}

    /** Creates a handler on the stores of a processor. */
    public static DomainCommandHandler handler(
            ProcessorContext<?, ?> context, DomainMissions missions, EventPublisher publisher) {
        Table<FieldVersion> fields = StoreTable.of(context, FIELDS, FieldVersion::toBytes, DomainManager::readable);
        DomainCommandHandler.Dependencies dependencies =
                new DomainCommandHandler.Dependencies(sequence(context), quota(context), () -> all(fields));
        return new DomainCommandHandler(domains(context), missions, dependencies, publisher);
    }

    private static List<FieldVersion> all(Table<FieldVersion> fields) {
        List<FieldVersion> all = new ArrayList<>();
        fields.forEach(field -> {
            if (field != null) {
                all.add(field);
            }
        });
        return all;
    }

    /** Null of what is no version of a field; the jobs report it. */
    private static FieldVersion readable(byte[] value) {
        try {
            return FieldVersion.read(value);
        } catch (UnreadableException e) {
            return null;
        }
    }

    /** Names of the stores that other processors may use. */
    public static List<String> stores() {
        return List.of(DOMAINS, SEQUENCE);
    }

    /** Returns the stored domains, for a processor connected to {@link #stores()}. */
    public static Table<Domain> domains(ProcessorContext<?, ?> context) {
        return StoreTable.of(context, DOMAINS, Domain.class);
    }

    /** Returns the shared sequence of the desired state of domains, missions and devices. */
    public static Sequence sequence(ProcessorContext<?, ?> context) {
        return new Sequence(StoreTable.of(context, SEQUENCE, Long.class));
    }

    /** Returns the quota shared by all definitions of domains, missions and templates. */
    public static Quota quota(ProcessorContext<?, ?> context) {
        return new Quota(StoreTable.of(context, SEQUENCE, Long.class), Limits.DEFINITIONS_BYTES);
    }

    /**
     * @param remembered how long ids of requests are remembered
     * @param missions creates the access to missions, which needs further stores; these and {@link #stores()} must
     * exist already
     */
    public static void add(
            StreamsBuilder builder,
            Duration remembered,
            BiFunction<ProcessorContext<?, ?>, EventPublisher, DomainMissions> missions,
            List<String> storesOfMissions) {
        builder.addGlobalStore(
                StoreTable.builder(FIELDS).withLoggingDisabled(),
                Topics.FIELDS,
                Consumed.with(Serdes.String(), Serdes.ByteArray()).withName("fields-in"),
                () -> new GlobalStoreProcessor(FIELDS));
        builder.addStateStore(RequestLog.builder(TOPIC.answers(), remembered));
        BiFunction<ProcessorContext<?, ?>, EventPublisher, CommandHandler<DomainCommand>> opening =
                (context, publisher) -> handler(context, missions.apply(context, publisher), publisher)::answer;
        String[] stores = Stream.of(stores(), storesOfMissions, List.of(TOPIC.answers()))
                .flatMap(List::stream)
                .toArray(String[]::new);

        OutputRecord.send(
                ManagerInput.requests(builder, TOPIC)
                        .process(
                                () -> new CommandProcessor<>(TOPIC, remembered, opening),
                                Named.as("answer-domain-requests"),
                                stores),
                "domains-out");
    }
}
