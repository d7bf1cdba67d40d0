package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import io.furrow.connect.sink.EntityUpdates.Update;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Cuts updates into requests of one scope, at most {@code maxCount} entities and {@code maxBytes} bytes each; an entity
 * that is larger goes alone.
 */
record Batches(int maxCount, long maxBytes) {
    List<List<Update>> cut(List<Update> updates) {
        Map<FiwareScope, List<Update>> byScope = new LinkedHashMap<>();
        updates.forEach(update -> byScope.computeIfAbsent(update.scope(), scope -> new ArrayList<>())
                .add(update));
        List<List<Update>> batches = new ArrayList<>();
        byScope.values().forEach(same -> cutInto(batches, same));
        return batches;
    }

    private void cutInto(List<List<Update>> batches, List<Update> same) {
        List<Update> batch = new ArrayList<>();
        long bytes = 0;
        for (Update update : same) {
            int size = NgsiJson.write(update.entity()).length + 1;
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
