package io.furrow.launcher.status;

import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;

/** Stores the newest average of each field and scope of its devices, as lines that name the scope if a field has several. */
final class Averages {
    private final Map<String, Map<String, String>> linesByField = new TreeMap<>();

    /** Returns the line of the average. */
    String put(Entity entity, FiwareScope scope) {
        Map<String, String> lines = linesByField.computeIfAbsent(entity.id(), any -> new TreeMap<>());
        String name = (scope.service() + " " + scope.servicePath()).strip();
        lines.put(name, ResultLines.average(entity));
        return line(lines, name);
    }

    List<String> lines() {
        return linesByField.values().stream()
                .map(lines ->
                        lines.keySet().stream().map(name -> line(lines, name)).toList())
                .flatMap(Collection::stream)
                .toList();
    }

    private static String line(Map<String, String> lines, String name) {
        return lines.get(name) + (lines.size() > 1 ? " of " + name : "");
    }
}
