package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.List;

import org.apache.kafka.streams.processor.api.Record;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.Limits;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class UnitOfWorkTest {
    private final TestStores stores = new TestStores(List.of("one", "two"));
    private final Table<String> one = stores.unitOfWork().table("one", String.class);
    private final Table<String> two = stores.unitOfWork().table("two", String.class);

    @Test
    void appliesAllWritesOfTheWork() {
        stores.call(0, () -> {
            one.put("a", "1");
            two.put("b", "2");
            send("t", "a", 3);
            return null;
        });

        assertThat(stores.content()).contains("a=\"1\"", "b=\"2\"");
        assertThat(stores.publisher().all()).hasSize(1);
    }

    @Test
    void discardsTheWritesOfFailedWork() {
        stores.call(0, () -> put("kept"));
        String before = stores.content();

        assertThatThrownBy(() -> stores.call(0, () -> {
                    put("lost");
                    one.put("kept", null);
                    send("t", "a", 3);
                    throw new IllegalStateException("a fault");
                }))
                .hasMessage("a fault");
        assertThat(stores.content()).isEqualTo(before);

        stores.call(0, () -> put("later"));
        assertThat(stores.publisher().all()).isEmpty();
        assertThat(stores.content()).contains("later").doesNotContain("lost");
    }

    @Test
    void readsItsOwnWrites() {
        stores.call(0, () -> put("b"));
        stores.call(0, () -> {
            one.put("a", "1");
            one.put("c", "3");
            one.put("b", null);
            assertThat(one.get("a")).isEqualTo("1");
            assertThat(one.contains("b")).isFalse();
            List<String> all = new ArrayList<>();
            one.forEach(all::add);
            assertThat(all).containsExactly("1", "3");
            return null;
        });
        assertThat(stores.all(one)).containsExactly("1", "3");
    }

    @Test
    void rejectsOversizedRecords() {
        assertThatThrownBy(() -> stores.call(0, () -> {
                    put("small");
                    send("t", "a", Limits.RECORD_BYTES);
                    return null;
                }))
                .isInstanceOf(OversizedRecordException.class)
                .hasMessage("the record of 'a' on t would have 900003 bytes; at most 900000 are written");
        assertThatThrownBy(() -> stores.call(0, () -> {
                    one.put("large", "x".repeat(Limits.RECORD_BYTES));
                    return null;
                }))
                .isInstanceOf(OversizedRecordException.class)
                .hasMessageContaining("on one");
        assertThat(stores.all(one)).isEmpty();
        assertThat(stores.publisher().all()).isEmpty();
        stores.call(0, () -> {
            send("t", "a", Limits.RECORD_BYTES - 3);
            return null;
        });
        assertThat(stores.publisher().all()).hasSize(1);
    }

    private Void put(String key) {
        one.put(key, key);
        return null;
    }

    private void send(String topic, String key, int bytes) {
        stores.unitOfWork().forward(new Record<>(key, new OutputRecord(topic, new byte[bytes]), 0));
    }
}
