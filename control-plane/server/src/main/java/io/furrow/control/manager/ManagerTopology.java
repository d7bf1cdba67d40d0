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
 * Builds the topology of managers and observers. Records come to them each once, all in one line: one partition orders the requests of all
 * clients, so that of two that ask for one name the second one is rejected; a manager therefore runs on one instance at a time.
 * What is larger than {@link Limits#RECORD_BYTES} becomes a dead letter.
 */
public final class ManagerTopology {
    private static final String FITS = "-fits";
    private static final String OVERSIZED = "-oversized";

    private final StreamsBuilder builder = new StreamsBuilder();
    private final Duration remembered;

    /** @param remembered how long ids of requests are */
    public ManagerTopology(Duration remembered) {
        this.remembered = remembered;
    }

    public Topology build() {
        return builder.build();
    }

    public void addStores(List<String> names) {
        names.forEach(name -> builder.addStateStore(StoreTable.builder(name)));
    }

    /** A compacted topic in a store, which each instance has whole and processors need not name. */
    public void addGlobalStore(String name, String topic) {
        builder.addGlobalStore(
                StoreTable.builder(name).withLoggingDisabled(),
                topic,
                from(name + "-in"),
                () -> new GlobalStoreProcessor(name));
    }

    /** Answers the requests to a manager. @param opening makes the handler, on stores that exist already */
    public <C extends Command> void addManager(
            ManagerTopic<C> manager, Function<UnitOfWork, CommandHandler<C>> opening, List<String> stores) {
        builder.addStateStore(RequestLog.builder(manager.answers(), remembered));
        String name = manager.name();
        KStream<String, byte[]> accepted = builder.stream(manager.topic(), from(name + "-requests-in"))
                .process(() -> new RequestProcessor(manager), Named.as(name + "-accept"));
        send(
                once(toSinglePartition(accepted, name + "-requests"), name),
                () -> new CommandProcessor<>(manager, remembered, opening),
                new Nodes("answer-" + name + "-requests", name + "s-out"),
                Stream.concat(stores.stream(), Stream.of(manager.answers())));
    }

    /** Observes a topic on which executors report statuses. @param opening makes the observer, on stores that exist already */
    public void addStatuses(
            String topic,
            String name,
            String output,
            Function<UnitOfWork, Observer.OfStatuses> opening,
            List<String> stores) {
        observe(
                observed(builder.stream(topic, from(name + "-in")), name),
                new Nodes("take-" + name, output),
                opening,
                stores);
    }

    /** Observes records. @param opening makes the observer, on stores that exist already */
    public static void observe(
            KStream<String, byte[]> records,
            Nodes nodes,
            Function<UnitOfWork, ? extends Observer> opening,
            List<String> stores) {
        send(records, () -> new EventProcessor(opening, true), nodes, stores.stream());
    }

    /** The same beside another observer of the same records, which writes the dead letters of what cannot be read. */
    public static void observeBesideAnother(
            KStream<String, byte[]> records,
            Nodes nodes,
            Function<UnitOfWork, ? extends Observer> opening,
            List<String> stores) {
        send(records, () -> new EventProcessor(opening, false), nodes, stores.stream());
    }

    /** Names of nodes: of the processor, and of its output. */
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

    /** The records of a topic as they come. @param start where to begin when it was never read */
    public KStream<String, byte[]> stream(String topic, String node, AutoOffsetReset start) {
        return builder.stream(topic, from(node).withOffsetResetPolicy(start));
    }

    /** The records of a topic, each once and all in one line. @param start where to begin when it was never read */
    public KStream<String, byte[]> observed(String topic, String name, AutoOffsetReset start) {
        return observed(stream(topic, name + "-in", start), name);
    }

    private KStream<String, byte[]> observed(KStream<String, byte[]> stream, String name) {
        return once(
                toSinglePartition(stream.process(SourcePositionProcessor::new, Named.as(name + "-note-origin")), name),
                name);
    }

    private static Consumed<String, byte[]> from(String node) {
        return Consumed.with(Serdes.String(), Serdes.ByteArray()).withName(node);
    }

    /** Positions are written to the changelog once per commit, not once per record. */
    private KStream<String, byte[]> once(KStream<String, byte[]> line, String name) {
        String positions = name + "-positions";
        builder.addStateStore(StoreTable.builder(positions).withCachingEnabled());
        return line.process(() -> new DeduplicationProcessor(positions), Named.as(name + "-take-once"), positions);
    }

    /** In the order in which they come, all on one instance at a time. */
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

    /** Makes a dead letter of a record that is too large to be handled. */
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
