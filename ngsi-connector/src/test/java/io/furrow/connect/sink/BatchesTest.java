package io.furrow.connect.sink;

import java.util.List;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Test;

import io.furrow.connect.sink.EntityUpdates.Update;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class BatchesTest {
    @Test
    void cutsByScopeAndCount() {
        FiwareScope other = new FiwareScope("agri", "/");
        List<Update> updates = IntStream.range(0, 7)
                .mapToObj(i -> update(i % 2 == 0 ? FiwareScope.DEFAULT : other, "e" + i, ""))
                .toList();

        assertThat(new Batches(2, 100_000).cut(updates))
                .extracting(batch -> batch.stream()
                        .map(update -> update.entity().get("id").textValue())
                        .toList())
                .containsExactly(List.of("e0", "e2"), List.of("e4", "e6"), List.of("e1", "e3"), List.of("e5"));
    }

    @Test
    void cutsByBytesAndLetsALargeEntityGoAlone() {
        List<Update> updates = List.of(
                update(FiwareScope.DEFAULT, "small", "x"),
                update(FiwareScope.DEFAULT, "large", "x".repeat(5000)),
                update(FiwareScope.DEFAULT, "small2", "x"),
                update(FiwareScope.DEFAULT, "small3", "x"));

        assertThat(new Batches(100, 1000).cut(updates)).extracting(List::size).containsExactly(1, 1, 2);
    }

    private static Update update(FiwareScope scope, String id, String text) {
        return new Update(
                scope, Entity.builder(id, "T").text("text", text).build().json(), List.of(0));
    }
}
