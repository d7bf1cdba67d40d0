package io.furrow.control.manager;

import java.util.Map;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Branched;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.kstream.Repartitioned;

import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.Reason;

/**
 * How records come to a manager: each once, all in one line. One partition orders the requests of all clients, so that of two
 * that ask for one name the second one is rejected; a manager therefore runs on one instance at a time. What is larger than {@link
 * Limits#RECORD_BYTES} becomes a dead letter.
 */
public final class ManagerInput {
    private static final String FITS = "-fits";
    private static final String OVERSIZED = "-oversized";

    private ManagerInput() {}

    /** The requests to a manager; a missing key is empty. */
    public static KStream<String, byte[]> requests(StreamsBuilder builder, ManagerTopic<?> manager) {
        KStream<String, byte[]> accepted = builder.stream(manager.topic(), from(manager.name() + "-requests-in"))
                .process(() -> new RequestProcessor(manager), Named.as(manager.name() + "-accept"));
        return once(builder, toSinglePartition(accepted, manager.name() + "-requests"), manager.name());
    }

    /** A topic on which executors say what is. */
    public static KStream<String, byte[]> statuses(StreamsBuilder builder, String topic, String name) {
        return withOrigin(builder, builder.stream(topic, from(name + "-in")), name);
    }

    /**
     * A topic that is observed, all in one line.
     *
     * @param start where to begin when it was never read
     */
    public static KStream<String, byte[]> observed(
            StreamsBuilder builder, String topic, String name, AutoOffsetReset start) {
        return withOrigin(builder, builder.stream(topic, from(name + "-in").withOffsetResetPolicy(start)), name);
    }

    private static KStream<String, byte[]> withOrigin(
            StreamsBuilder builder, KStream<String, byte[]> stream, String name) {
        return once(
                builder,
                toSinglePartition(stream.process(SourcePositionProcessor::new, Named.as(name + "-note-origin")), name),
                name);
    }

    /** Positions are written to the changelog once per commit, not once per record. */
    private static KStream<String, byte[]> once(StreamsBuilder builder, KStream<String, byte[]> line, String name) {
        String positions = name + "-positions";
        builder.addStateStore(StoreTable.builder(positions).withCachingEnabled());
        return line.process(() -> new DeduplicationProcessor(positions), Named.as(name + "-take-once"), positions);
    }

    /** In the order in which they come, all on one instance at a time. */
    public static KStream<String, byte[]> toSinglePartition(KStream<String, byte[]> stream, String name) {
        Map<String, KStream<String, byte[]>> bySize = stream.split(Named.as(name))
                .branch(ManagerInput::fits, Branched.as(FITS))
                .defaultBranch(Branched.as(OVERSIZED));
        OutputRecord.send(
                bySize.get(name + OVERSIZED).process(RejectOversized::new, Named.as(name + "-refuse-oversized")),
                name + "-oversized-out");
        return bySize.get(name + FITS)
                .repartition(Repartitioned.with(Serdes.String(), Serdes.ByteArray())
                        .withName(name)
                        .withNumberOfPartitions(1));
    }

    private static boolean fits(String key, byte[] value) {
        return OversizedRecordException.size(key, value) <= Limits.RECORD_BYTES;
    }

    private static Consumed<String, byte[]> from(String name) {
        return Consumed.with(Serdes.String(), Serdes.ByteArray()).withName(name);
    }

    /** Makes a dead letter of a record that is too large to be handled. */
    private static final class RejectOversized
            extends org.apache.kafka.streams.processor.api.ContextualProcessor<String, byte[], String, OutputRecord> {
        @Override
        public void process(org.apache.kafka.streams.processor.api.Record<String, byte[]> record) {
            String message = "a record of %d bytes; the control plane handles at most %d"
                    .formatted(OversizedRecordException.size(record.key(), record.value()), Limits.RECORD_BYTES);
            RecordOrigin.of(record)
                    .ifPresent(origin ->
                            context().forward(DeadLetterRecords.of(record, origin, Reason.TOO_LARGE, message)));
        }
    }
}
