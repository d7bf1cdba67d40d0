package io.furrow.control.manager;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.Topology;
import org.apache.kafka.streams.kstream.Branched;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.kstream.Produced;
import org.apache.kafka.streams.kstream.Repartitioned;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorSupplier;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.control.Command;
import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.Reason;

/**
 * Builds the topology of managers and observers. They receive each record once, all through a single partition: it
 * orders the requests of all clients, so that the second of two requests for the same name is rejected. A manager
 * therefore runs on one instance at a time. Records larger than {@link Limits#RECORD_BYTES} become dead letters.
 */
public final class ManagerTopology {
    private static final String FITS = "-fits";
    private static final String OVERSIZED = "-oversized";

    private final StreamsBuilder builder = new StreamsBuilder();
    private final Duration requestRetention;

    /** @param requestRetention how long ids of requests are stored for deduplication */
    public ManagerTopology(Duration requestRetention) {
        this.requestRetention = requestRetention;
    }

    public Topology build() {
        return builder.build();
    }

    public void addStores(List<String> names) {
        names.forEach(name -> builder.addStateStore(StoreTable.builder(name)));
    }

    /** Adds a global store of a compacted topic, which processors need not declare. */
    public void addGlobalStore(String name, String topic) {
        builder.addGlobalStore(
                StoreTable.builder(name).withLoggingDisabled(),
                topic,
                from(name + "-in"),
                () -> new GlobalStoreProcessor(name));
    }

    /** Adds a manager. @param handlerFactory creates the handler on stores that exist already */
    public <C extends Command> void addManager(
            ManagerTopic<C> manager, Function<UnitOfWork, CommandHandler<C>> handlerFactory, List<String> stores) {
        builder.addStateStore(RequestLog.builder(manager.answers(), requestRetention));
        String name = manager.name();
        KStream<String, byte[]> accepted = builder.stream(manager.topic(), from(name + "-requests-in"))
                .process(() -> new RequestProcessor(manager), Named.as(name + "-accept"));
        send(
                deduplicated(toSinglePartition(accepted, name + "-requests"), name),
                () -> new CommandProcessor<>(manager, requestRetention, handlerFactory),
                new Nodes("answer-" + name + "-requests", name + "s-out"),
                Stream.concat(stores.stream(), Stream.of(manager.answers())));
    }

    /**
     * Observes a topic of reported statuses.
     *
     * @param observerFactory creates the observer on stores that exist already
     */
    public void addStatuses(
            String topic,
            String name,
            String output,
            Function<UnitOfWork, Observer.OfStatuses> observerFactory,
            List<String> stores) {
        observe(
                observed(builder.stream(topic, from(name + "-in")), name),
                new Nodes("take-" + name, output),
                true,
                observerFactory,
                stores);
    }

    /**
     * Observes records.
     *
     * @param writesUnreadable whether unreadable records become dead letters; false if another observer of the same
     *     records writes them
     * @param observerFactory creates the observer on stores that exist already
     */
    public static void observe(
            KStream<String, byte[]> records,
            Nodes nodes,
            boolean writesUnreadable,
            Function<UnitOfWork, ? extends Observer> observerFactory,
            List<String> stores) {
        send(records, () -> new EventProcessor(observerFactory, writesUnreadable), nodes, stores.stream());
    }

    public record Nodes(String processor, String output) {}

    private static void send(
            KStream<String, byte[]> records,
            ProcessorSupplier<String, byte[], String, OutputRecord> processors,
            Nodes nodes,
            Stream<String> stores) {
        records.process(processors, Named.as(nodes.processor()), stores.toArray(String[]::new))
                .to(
                        (key, outgoing, context) -> outgoing.topic(),
                        Produced.with(Serdes.String(), OutputRecord.SERDE).withName(nodes.output()));
    }

    /** Returns the records of a topic. @param start position if the topic was never read */
    public KStream<String, byte[]> stream(String topic, String node, AutoOffsetReset start) {
        return builder.stream(topic, from(node).withOffsetResetPolicy(start));
    }

    /**
     * Returns the records of a topic, deduplicated, in a single partition.
     *
     * @param start position if the topic was never read
     */
    public KStream<String, byte[]> observed(String topic, String name, AutoOffsetReset start) {
        return observed(stream(topic, name + "-in", start), name);
    }

    private KStream<String, byte[]> observed(KStream<String, byte[]> stream, String name) {
        return deduplicated(
                toSinglePartition(stream.process(SourcePositionProcessor::new, Named.as(name + "-note-origin")), name),
                name);
    }

    private static Consumed<String, byte[]> from(String node) {
        return Consumed.with(Serdes.String(), Serdes.ByteArray()).withName(node);
    }

    /** Positions are written to the changelog once per commit, not once per record. */
    private KStream<String, byte[]> deduplicated(KStream<String, byte[]> records, String name) {
        String positions = name + "-positions";
        builder.addStateStore(StoreTable.builder(positions).withCachingEnabled());
        return records.process(() -> new DeduplicationProcessor(positions), Named.as(name + "-take-once"), positions);
    }

    /** Routes the records through a single partition, which one instance processes at a time. */
    public static KStream<String, byte[]> toSinglePartition(KStream<String, byte[]> stream, String name) {
        Map<String, KStream<String, byte[]>> bySize = stream.split(Named.as(name))
                .branch(
                        (key, value) -> OversizedRecordException.size(key, value) <= Limits.RECORD_BYTES,
                        Branched.as(FITS))
                .defaultBranch(Branched.as(OVERSIZED));
        send(
                bySize.get(name + OVERSIZED),
                RejectOversized::new,
                new Nodes(name + "-refuse-oversized", name + "-oversized-out"),
                Stream.of());
        return bySize.get(name + FITS)
                .repartition(Repartitioned.with(Serdes.String(), Serdes.ByteArray())
                        .withName(name)
                        .withNumberOfPartitions(1));
    }

    /** Converts a record that is too large to a dead letter. */
    private static final class RejectOversized extends ContextualProcessor<String, byte[], String, OutputRecord> {
        @Override
        public void process(Record<String, byte[]> record) {
            String message = "a record of %d bytes; the control plane handles at most %d"
                    .formatted(OversizedRecordException.size(record.key(), record.value()), Limits.RECORD_BYTES);
            RecordOrigin.of(record)
                    .ifPresent(origin ->
                            context().forward(DeadLetterRecords.of(record, origin, Reason.TOO_LARGE, message)));
        }
    }
}
