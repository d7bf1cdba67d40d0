package io.furrow.control.manager;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.kstream.Repartitioned;

/**
 * How records come to a manager: each once, all in one line. One partition orders the requests of all clients, so that of two
 * that ask for one name the second is told; a manager therefore runs on one instance at a time.
 */
public final class Inlet {
    private Inlet() {}

    /** The requests to a manager; a missing key is empty. */
    public static KStream<String, byte[]> requests(StreamsBuilder builder, ManagerTopic<?> manager) {
        builder.addStateStore(StoreRecords.builder(manager.positions()));
        KStream<String, byte[]> noted = builder.stream(manager.topic(), from(manager.name() + "-requests-in"))
                .process(() -> new NoteOrigin(manager), Named.as(manager.name() + "-note-origin"));
        return inLine(noted, manager.name() + "-requests")
                .process(() -> new TakeOnce(manager), Named.as(manager.name() + "-take-once"), manager.positions());
    }

    /** A topic on which executors say what is. */
    public static KStream<String, byte[]> statuses(StreamsBuilder builder, String topic, String name) {
        return inLine(builder.stream(topic, from(name + "-in")), name);
    }

    /**
     * A topic that is observed, all in one line.
     *
     * @param start where to begin when it was never read
     */
    public static KStream<String, byte[]> observed(
            StreamsBuilder builder, String topic, String name, AutoOffsetReset start) {
        return inLine(builder.stream(topic, from(name + "-in").withOffsetResetPolicy(start)), name);
    }

    /** In the order in which they come, all on one instance at a time. */
    public static KStream<String, byte[]> inLine(KStream<String, byte[]> stream, String name) {
        return stream.repartition(Repartitioned.with(Serdes.String(), Serdes.ByteArray())
                .withName(name)
                .withNumberOfPartitions(1));
    }

    private static Consumed<String, byte[]> from(String name) {
        return Consumed.with(Serdes.String(), Serdes.ByteArray()).withName(name);
    }
}
