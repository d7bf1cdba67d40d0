package io.furrow.dashboard.feed;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.http.Problem;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class InitialStateTest {
    private static final byte[] LARGE = new byte[20 * 1024 * 1024];

    private final InitialState.Newest newest = new InitialState.Newest(new StateBudget(Long.MAX_VALUE).share());

    @Test
    void refusesMoreBytesThanMayWait() {
        for (int i = 0; i < 10; i++) {
            newest.put(record("same", LARGE)); // replaces the one before
            newest.check("t", 10);
        }
        newest.put(record("b", LARGE));
        newest.put(record("c", LARGE));
        newest.check("t", 10);
        newest.delete(record("b", null));
        newest.put(record("d", LARGE));
        newest.check("t", 10);
        newest.put(record("e", LARGE));
        assertThatThrownBy(() -> newest.check("t", 10))
                .isInstanceOf(Problem.class)
                .hasMessage("the state of topic 't' has more than 64 MiB");
        newest.clear();
        newest.put(record("f", LARGE));
        newest.check("t", 10);
    }

    private static FeedRecord record(String key, byte[] value) {
        return new FeedRecord(new ConsumerRecord<>("t", 0, 0, key.getBytes(UTF_8), value), FeedRecord.NO_SEQUENCE, 100);
    }
}
