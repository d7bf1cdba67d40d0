package io.furrow.connect.repair;

import java.time.Instant;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import org.junit.jupiter.api.RepeatedTest;
import org.junit.jupiter.api.Test;

import io.furrow.connect.repair.KeysetReader.Page;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class KeysetReaderTest {
    private static final Instant START = Instant.ofEpochMilli(1000);

    /** Entities by id, with the millisecond of their last change; a clock that never steps back. */
    private static final class Store {
        private final Map<String, Long> changed = new HashMap<>();
        private long clock = START.toEpochMilli();
        private Comparator<String> ties = Comparator.naturalOrder();
        private int asked;

        private void change(String id) {
            changed.put(id, clock);
        }

        private Page page(Instant from, int offset, int limit) {
            asked++;
            List<EntityState> page = changed.keySet().stream()
                    .filter(id -> changed.get(id) >= from.toEpochMilli())
                    .sorted(Comparator.<String, Long>comparing(changed::get).thenComparing(ties))
                    .skip(offset)
                    .limit(limit)
                    .map(this::state)
                    .toList();
            return new Page(page, limit, page.size() == limit);
        }

        private EntityState state(String id) {
            Entity entity = Entity.builder(id, "Probe").build();
            return new EntityState(entity, FiwareScope.DEFAULT, Instant.ofEpochMilli(changed.get(id)));
        }
    }

    /** The newest state read of each entity is its newest state in the end, whatever changes between any two pages. */
    @RepeatedTest(500)
    void missesNoChangeThatHappensWhileItReads() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        Store store = new Store();
        int entities = 1 + random.nextInt(60);
        for (int i = 0; i < entities; i++) {
            store.clock += random.nextInt(10) < 7 ? 0 : 1 + random.nextInt(3);
            store.change("e" + i);
        }
        int[] disturbances = {random.nextInt(200)};
        Map<String, Long> read = new HashMap<>();

        new KeysetReader(
                        (from, offset, limit) -> {
                            for (int i = random.nextInt(4); i > 0 && disturbances[0] > 0; i--, disturbances[0]--) {
                                store.clock += random.nextInt(2);
                                store.change("e" + random.nextInt(entities + 5));
                            }
                            return store.page(from, offset, limit);
                        },
                        2 + random.nextInt(6))
                .readFrom(
                        START,
                        states -> states.forEach(state ->
                                read.put(state.entity().id(), state.time().toEpochMilli())));

        assertThat(read).as("seed %d", seed).isEqualTo(store.changed);
    }

    @Test
    void givesNoStateTwice() throws Exception {
        Store store = new Store();
        for (int i = 0; i < 50; i++) {
            store.clock += i % 5 == 0 ? 1 : 0;
            store.change("e" + i);
        }
        List<String> read = new ArrayList<>();

        new KeysetReader(store::page, 4)
                .readFrom(START, states -> states.forEach(state -> read.add(state.identity() + state.time())));

        assertThat(read).hasSize(50).doesNotHaveDuplicates();
    }

    @Test
    void readsNothingFromBeforeTheStart() throws Exception {
        Store store = new Store();
        store.change("before");
        store.clock++;
        store.change("after");
        List<String> read = new ArrayList<>();

        new KeysetReader(store::page, 10)
                .readFrom(
                        START.plusMillis(1),
                        states ->
                                states.forEach(state -> read.add(state.entity().id())));

        assertThat(read).containsExactly("after");
    }

    /** As a database may, see Orion's issue 4394. */
    @Test
    void comesToAnEndWhereOneMillisecondIsOrderedDifferentlyEachTime() throws Exception {
        Store store = new Store();
        Random random = new Random(7);
        for (int i = 0; i < 20; i++) {
            store.change("e" + i);
        }

        new KeysetReader(
                        (from, offset, limit) -> {
                            int salt = random.nextInt();
                            store.ties = Comparator.comparing(id -> (id + salt).hashCode());
                            return store.page(from, offset, limit);
                        },
                        4)
                .readFrom(START, states -> {});

        assertThat(store.asked).isLessThan(1000);
    }
}
