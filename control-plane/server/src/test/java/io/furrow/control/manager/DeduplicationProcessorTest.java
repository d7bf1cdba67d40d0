package io.furrow.control.manager;

import java.util.List;
import java.util.Properties;

import org.apache.kafka.streams.processor.api.MockProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.state.KeyValueStore;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class DeduplicationProcessorTest {
    private static final String STORE = "positions";

    private final MockProcessorContext<String, byte[]> context = new MockProcessorContext<>(new Properties());
    private final DeduplicationProcessor processor = new DeduplicationProcessor(STORE);

    @BeforeEach
    void open() {
        KeyValueStore<String, byte[]> store =
                StoreTable.builder(STORE).withLoggingDisabled().build();
        store.init(context.getStateStoreContext(), store);
        context.addStateStore(store);
        processor.init(context);
    }

    @Test
    void skipsRecordsThatAreReadAgain() {
        read(0, 1000);
        read(1, 900);
        read(2, 1100);
        read(0, 1000);
        read(1, 900);
        read(2, 1100);
        assertThat(processed()).containsExactly(1000L, 900L, 1100L);

        read(3, 1000);
        assertThat(processed()).hasSize(4);
    }

    @Test
    void acceptsRecordsOfARecreatedTopic() {
        read(5, 1000);
        read(0, 2000);
        read(1, 2000);
        assertThat(processed()).containsExactly(1000L, 2000L, 2000L);
    }

    private void read(long offset, long timestamp) {
        Record<String, byte[]> request = new Record<>("", new byte[0], timestamp);
        new RecordOrigin(Topics.DOMAIN_MANAGER, 0, offset).addTo(request);
        processor.process(request);
    }

    private List<Long> processed() {
        return context.forwarded().stream()
                .map(forward -> forward.record().timestamp())
                .toList();
    }
}
