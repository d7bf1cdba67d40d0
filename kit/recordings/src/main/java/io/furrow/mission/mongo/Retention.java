package io.furrow.mission.mongo;

import java.io.Serializable;
import java.time.Duration;
import java.util.Collection;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.stream.Stream;

/**
 * How long the documents of each mission are stored after their event time.
 *
 * @param byDefault for other missions; null to store them forever
 * @param byCollection by collection
 */
public record Retention(Duration byDefault, TreeMap<String, Duration> byCollection) implements Serializable {
    public static final Retention FOR_EVER = new Retention(null, new TreeMap<>());

    public static Retention of(Duration byDefault, Map<String, Duration> byMission) {
        TreeMap<String, Duration> named = new TreeMap<>();
        byMission.forEach((mission, duration) -> named.put(MissionCollections.nameOf(mission), duration));
        return new Retention(byDefault, named);
    }

    /** Returns the retention of a collection; empty to store it forever. */
    public Optional<Duration> of(String collection) {
        return Optional.ofNullable(byCollection.getOrDefault(collection, byDefault));
    }

    /** Returns the shortest retention. */
    public Optional<Duration> shortest() {
        Collection<Duration> named = byCollection.values();
        return Stream.concat(Optional.ofNullable(byDefault).stream(), named.stream())
                .min(Duration::compareTo);
    }
}
