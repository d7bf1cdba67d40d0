package io.furrow.mission.mongo;

import java.io.Serializable;
import java.time.Duration;
import java.util.Collection;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

/**
 * How long the documents of each mission are kept after their event time.
 *
 * @param everywhere for missions that are not named; null to keep them forever
 * @param byCollection for those that are
 */
public record Retention(Duration everywhere, TreeMap<String, Duration> byCollection) implements Serializable {
    public static final Retention FOR_EVER = new Retention(null, new TreeMap<>());

    public static Retention of(Duration everywhere, Map<String, Duration> byMission) {
        TreeMap<String, Duration> named = new TreeMap<>();
        byMission.forEach((mission, kept) -> named.put(MissionCollections.nameOf(mission), kept));
        return new Retention(everywhere, named);
    }

    /** Empty forever. */
    public Optional<Duration> of(String collection) {
        return Optional.ofNullable(byCollection.getOrDefault(collection, everywhere));
    }

    /** The shortest that is asked for. */
    public Optional<Duration> shortest() {
        Collection<Duration> named = byCollection.values();
        return java.util.stream.Stream.concat(Optional.ofNullable(everywhere).stream(), named.stream())
                .min(Duration::compareTo);
    }
}
