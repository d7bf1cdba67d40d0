package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import io.furrow.model.event.FiwareScope;

/**
 * Splits updates or deletions into requests of one scope, at most {@code maxCount} entities and {@code maxBytes} bytes
 * each; a larger entity is sent alone.
 */
public record Batches(int maxCount, long maxBytes) {
    /** An update or a deletion, its scope, and its JSON, which is written once. */
    public record Rendered<T>(T of, FiwareScope scope, byte[] json) {}

    <T> List<List<Rendered<T>>> cut(List<Rendered<T>> all) {
        Map<FiwareScope, List<Rendered<T>>> byScope = new LinkedHashMap<>();
        all.forEach(one ->
                byScope.computeIfAbsent(one.scope(), scope -> new ArrayList<>()).add(one));
        List<List<Rendered<T>>> batches = new ArrayList<>();
        byScope.values().forEach(same -> cutInto(batches, same));
        return batches;
    }

    private <T> void cutInto(List<List<Rendered<T>>> batches, List<Rendered<T>> same) {
        List<Rendered<T>> batch = new ArrayList<>();
        long bytes = 0;
        for (Rendered<T> one : same) {
            int size = one.json().length + 1;
            if (!batch.isEmpty() && (batch.size() == maxCount || bytes + size > maxBytes)) {
                batches.add(batch);
                batch = new ArrayList<>();
                bytes = 0;
            }
            batch.add(one);
            bytes += size;
        }
        if (!batch.isEmpty()) {
            batches.add(batch);
        }
    }
}
