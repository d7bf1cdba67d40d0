package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.streams.processor.api.MockProcessorContext;
import org.apache.kafka.streams.state.KeyValueIterator;
import org.apache.kafka.streams.state.KeyValueStore;

/** Provides the stores of a processor without Kafka, with the atomic writes of managers. */
public final class TestStores {
    private final Map<String, KeyValueStore<String, byte[]>> stores = new LinkedHashMap<>();
    private final MockProcessorContext<String, OutputRecord> context = new MockProcessorContext<>();
    private final UnitOfWork unitOfWork = new UnitOfWork(context);
    private final CapturingPublisher publisher = new CapturingPublisher();

    public TestStores(List<String> names) {
        for (String name : names) {
            KeyValueStore<String, byte[]> store =
                    StoreTable.builder(name).withLoggingDisabled().build();
            store.init(context.getStateStoreContext(), store);
            context.addStateStore(store);
            stores.put(name, store);
        }
    }

    public UnitOfWork unitOfWork() {
        return unitOfWork;
    }

    public CapturingPublisher publisher() {
        return publisher;
    }

    /** Runs work atomically at a time, epoch ms. */
    public <T, E extends Exception> T call(long now, UnitOfWork.Work<T, E> work) throws E {
        context.setCurrentSystemTimeMs(now);
        T result = unitOfWork.call(work);
        context.forwarded()
                .forEach(each -> publisher.put(
                        each.record().value().topic(),
                        each.record().key(),
                        each.record().value().value()));
        context.resetForwards();
        return result;
    }

    public <T> List<T> all(Table<T> records) {
        List<T> all = new ArrayList<>();
        records.forEach(all::add);
        return all;
    }

    /** Returns the content of all stores, for comparisons. */
    public String content() {
        StringBuilder content = new StringBuilder();
        stores.forEach((name, store) -> {
            content.append(name).append('\n');
            try (KeyValueIterator<String, byte[]> all = store.all()) {
                all.forEachRemaining(entry -> content.append(entry.key)
                        .append('=')
                        .append(new String(entry.value))
                        .append('\n'));
            }
        });
        return content.toString();
    }
}
