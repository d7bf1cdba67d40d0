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
 * Makes the writes of a processor to its stores and output atomic: {@link #call} stages them and applies them when the
 * work returns. Work that throws changes nothing, and no record larger than {@code Limits.RECORD_BYTES} is written, so
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
     * @param <E> exception for rejections
     */
    @FunctionalInterface
    public interface Work<T, E extends Exception> {
        T run() throws E;
    }

    UnitOfWork(ProcessorContext<String, OutputRecord> context) {
        this.context = context;
    }

    /**
     * Runs the work and applies its writes; discards them if it throws.
     *
     * @throws OversizedRecordException if it wrote a record that is too large; nothing is applied then
     */
    public <T, E extends Exception> T call(Work<T, E> work) throws E {
        return run(work, true);
    }

    /** Runs the work and discards its writes; fails if {@link #call} would. */
    <T, E extends Exception> T preview(Work<T, E> work) throws E {
        return run(work, false);
    }

    private <T, E extends Exception> T run(Work<T, E> work, boolean applies) throws E {
        boolean done = false;
        try {
            T result = work.run();
            staged.forEach(record -> OversizedRecordException.check(
                    record.value().topic(), record.key(), record.value().value()));
            stores.values().forEach(BufferedStore::check);
            if (applies) {
                done = true;
                apply();
            }
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

    /** Writes a record with the current time of the control plane's clock. */
    @Override
    public void put(String topic, String key, byte[] value) {
        forward(new Record<>(key, new OutputRecord(topic, value), now()));
    }

    /** Writes a record with its own time and headers. */
    public void forward(Record<String, OutputRecord> record) {
        staged.add(record);
    }

    /** Returns the time of the control plane's clock, epoch ms. */
    public long now() {
        return context.currentSystemTimeMs();
    }

    public Table<byte[]> table(String store) {
        return stores.computeIfAbsent(store, name -> new BufferedStore(context.getStateStore(name)));
    }

    /** Returns the values of a store that are stored as JSON. */
    public <T> Table<T> table(String store, Class<T> type) {
        return table(store, StateJson::write, json -> StateJson.read(json, type));
    }

    /** Returns the values of a store with a custom format. */
    public <T> Table<T> table(String store, Function<T, byte[]> writer, Function<byte[], T> reader) {
        return new StoreTable<>(table(store), writer, reader);
    }
}
