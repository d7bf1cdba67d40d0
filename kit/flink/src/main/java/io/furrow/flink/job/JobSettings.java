package io.furrow.flink.job;

import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import org.apache.flink.configuration.ConfigOption;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.ReadableConfig;

/**
 * The settings of a job: by its options, else by the cluster's configuration or {@code -D}, else Furrow's default. Records the
 * origin of each.
 */
final class JobSettings {
    private final ReadableConfig cluster;
    private final Configuration settings = new Configuration();
    private final Map<String, String> origins = new TreeMap<>();

    /** @param cluster its configuration, including {@code -D} */
    JobSettings(ReadableConfig cluster) {
        this.cluster = cluster;
    }

    /** Sets a value that every job must have. */
    <T> void fix(ConfigOption<T> option, T value) {
        settings.set(option, value);
    }

    /** Sets a value from an option; if empty, the cluster's applies. */
    <T> void set(ConfigOption<T> option, Optional<T> given) {
        given.ifPresent(value -> set(option, value, "option"));
        if (given.isEmpty() && says(option)) {
            note(option, cluster.get(option), "cluster");
        }
    }

    /** The same, with a default if the cluster has no value either. */
    <T> void set(ConfigOption<T> option, Optional<T> given, T otherwise) {
        set(option, given);
        if (given.isEmpty() && !says(option)) {
            set(option, otherwise, "default");
        }
    }

    <T> void set(ConfigOption<T> option, T value, String origin) {
        settings.set(option, value);
        note(option, value, origin);
    }

    /** The effective value. */
    <T> T get(ConfigOption<T> option) {
        return settings.getOptional(option).orElseGet(() -> cluster.get(option));
    }

    boolean says(ConfigOption<?> option) {
        return cluster.getOptional(option).isPresent();
    }

    /** The values that override the cluster's configuration. */
    Configuration overlay() {
        return settings;
    }

    /**
     * Effective values by their names in Flink's configuration, as in {@code 10 s (default)}: from an option, the cluster or by
     * default.
     */
    Map<String, String> origins() {
        return origins;
    }

    private <T> void note(ConfigOption<T> option, T value, String origin) {
        Configuration written = new Configuration();
        written.set(option, value);
        origins.put(option.key(), JobOptions.masked(written.toMap().get(option.key())) + " (" + origin + ")");
    }
}
