package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import io.furrow.model.event.FiwareScope;

/**
 * Cuts updates into requests of one scope, at most {@code maxCount} entities and {@code maxBytes} bytes each; an entity
 * that is larger goes alone.
 */
record Batches(int maxCount, long maxBytes) {
    /** An update and its JSON, which is written once. */
    record Rendered(Update update, byte[] json) {}

    List<List<Rendered>> cut(List<Rendered> updates) {
        Map<FiwareScope, List<Rendered>> byScope = new LinkedHashMap<>();
        updates.forEach(update -> byScope.computeIfAbsent(update.update().key().scope(), scope -> new ArrayList<>())
                .add(update));
        List<List<Rendered>> batches = new ArrayList<>();
        byScope.values().forEach(same -> cutInto(batches, same));
        return batches;
    }

    private void cutInto(List<List<Rendered>> batches, List<Rendered> same) {
        List<Rendered> batch = new ArrayList<>();
        long bytes = 0;
        for (Rendered update : same) {
            int size = update.json().length + 1;
            if (!batch.isEmpty() && (batch.size() == maxCount || bytes + size > maxBytes)) {
                batches.add(batch);
                batch = new ArrayList<>();
                bytes = 0;
            }
            batch.add(update);
            bytes += size;
        }
        if (!batch.isEmpty()) {
            batches.add(batch);
        }
    }
}
