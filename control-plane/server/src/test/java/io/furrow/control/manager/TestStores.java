package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.streams.processor.api.MockProcessorContext;
import org.apache.kafka.streams.state.KeyValueIterator;
import org.apache.kafka.streams.state.KeyValueStore;

/** The stores of a processor without Kafka, written as managers write them: as a whole or not at all. */
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

    /** For handlers. */
    public UnitOfWork unitOfWork() {
        return unitOfWork;
    }

    /** What was written to topics. */
    public CapturingPublisher publisher() {
        return publisher;
    }

    /** Works at a time, epoch ms, as a manager does. */
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

    /** What a store holds. */
    public <T> List<T> all(Table<T> records) {
        List<T> all = new ArrayList<>();
        records.forEach(all::add);
        return all;
    }

    /** All that all stores hold, to be compared. */
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
