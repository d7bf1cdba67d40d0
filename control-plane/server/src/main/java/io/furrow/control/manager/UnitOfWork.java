package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.ngsi.StateJson;

/**
 * The stores and the output of a processor, whose writes take effect together or not at all: within {@link #call} they are staged, and
 * applied when that returns. What throws has changed nothing, and no record larger than {@code Limits.RECORD_BYTES} is written, so
 * that neither can end the thread.
 */
public final class UnitOfWork implements EventPublisher {
    private final ProcessorContext<String, OutputRecord> context;
    private final Map<String, BufferedStore> stores = new LinkedHashMap<>();
    private final List<Record<String, OutputRecord>> staged = new ArrayList<>();

    /**
     * Work that reads and writes.
     *
     * @param <T> its result
     * @param <E> what it throws where it is refused
     */
    @FunctionalInterface
    public interface Work<T, E extends Exception> {
        T run() throws E;
    }

    UnitOfWork(ProcessorContext<String, OutputRecord> context) {
        this.context = context;
    }

    /**
     * Does the work and applies what it wrote; where it throws, nothing of it.
     *
     * @throws OversizedRecordException where it wrote a record that is too large, with nothing applied
     */
    public <T, E extends Exception> T call(Work<T, E> work) throws E {
        boolean done = false;
        try {
            T result = work.run();
            staged.forEach(record -> OversizedRecordException.check(
                    record.value().topic(), record.key(), record.value().value()));
            stores.values().forEach(BufferedStore::check);
            done = true;
            apply();
            return result;
        } finally {
            if (!done) {
                staged.clear();
                stores.values().forEach(BufferedStore::discard);
            }
        }
    }

    private void apply() {
        stores.values().forEach(BufferedStore::apply);
        List<Record<String, OutputRecord>> records = List.copyOf(staged);
        staged.clear();
        records.forEach(context::forward);
    }

    /** Writes under the time of the control plane's clock. */
    @Override
    public void put(String topic, String key, byte[] value) {
        forward(new Record<>(key, new OutputRecord(topic, value), now()));
    }

    /** Writes a record that has a time and headers. */
    public void forward(Record<String, OutputRecord> record) {
        staged.add(record);
    }

    /** The time of the control plane's clock, epoch ms. */
    public long now() {
        return context.currentSystemTimeMs();
    }

    /** The values in a store as they are. */
    public Table<byte[]> table(String store) {
        return stores.computeIfAbsent(store, name -> new BufferedStore(context.getStateStore(name)));
    }

    /** What is in a store as JSON of a type. */
    public <T> Table<T> table(String store, Class<T> type) {
        return table(store, StateJson::write, json -> StateJson.read(json, type));
    }

    /** What is in a store in a format of its own. */
    public <T> Table<T> table(String store, Function<T, byte[]> writer, Function<byte[], T> reader) {
        return new StoreTable<>(table(store), writer, reader);
    }
}
