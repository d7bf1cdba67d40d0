package io.furrow.control.manager;

import java.io.File;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.common.serialization.Serde;
import org.apache.kafka.streams.StreamsMetrics;
import org.apache.kafka.streams.processor.Cancellable;
import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.Punctuator;
import org.apache.kafka.streams.processor.StateStore;
import org.apache.kafka.streams.processor.TaskId;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.processor.api.RecordMetadata;
import org.apache.kafka.streams.state.KeyValueStore;

/**
 * The context of a processor whose writes, to its stores and to the next processors, take effect together or not at all: within
 * {@link #call} they are staged, and applied when that returns. What throws has changed nothing, and no record larger than
 * {@code Limits.RECORD_BYTES} is written, so that neither can end the thread. Its stores are key-value stores of texts and bytes.
 */
final class UnitOfWork implements ProcessorContext<String, OutputRecord> {
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

    @Override
    public <K extends String, V extends OutputRecord> void forward(Record<K, V> record) {
        staged.add(new Record<>(record.key(), record.value(), record.timestamp(), record.headers()));
    }

    @Override
    public <K extends String, V extends OutputRecord> void forward(Record<K, V> record, String childName) {
        throw new UnsupportedOperationException("records go to all next processors; name no child");
    }

    @Override
    @SuppressWarnings("unchecked")
    public <S extends StateStore> S getStateStore(String name) {
        return (S) stores.computeIfAbsent(name, any -> {
            KeyValueStore<String, byte[]> store = context.getStateStore(name);
            return new BufferedStore(store);
        });
    }

    @Override
    public String applicationId() {
        return context.applicationId();
    }

    @Override
    public TaskId taskId() {
        return context.taskId();
    }

    @Override
    public Optional<RecordMetadata> recordMetadata() {
        return context.recordMetadata();
    }

    @Override
    public Serde<?> keySerde() {
        return context.keySerde();
    }

    @Override
    public Serde<?> valueSerde() {
        return context.valueSerde();
    }

    @Override
    public File stateDir() {
        return context.stateDir();
    }

    @Override
    public StreamsMetrics metrics() {
        return context.metrics();
    }

    @Override
    public Cancellable schedule(Duration interval, PunctuationType type, Punctuator punctuator) {
        return context.schedule(interval, type, punctuator);
    }

    @Override
    public Cancellable schedule(Instant start, Duration interval, PunctuationType type, Punctuator punctuator) {
        return context.schedule(start, interval, type, punctuator);
    }

    @Override
    public void commit() {
        context.commit();
    }

    @Override
    public Map<String, Object> appConfigs() {
        return context.appConfigs();
    }

    @Override
    public Map<String, Object> appConfigsWithPrefix(String prefix) {
        return context.appConfigsWithPrefix(prefix);
    }

    @Override
    public long currentSystemTimeMs() {
        return context.currentSystemTimeMs();
    }

    @Override
    public long currentStreamTimeMs() {
        return context.currentStreamTimeMs();
    }
}
