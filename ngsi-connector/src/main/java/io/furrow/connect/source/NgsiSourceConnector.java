package io.furrow.connect.source;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

import org.apache.kafka.common.config.Config;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.connect.connector.Task;
import org.apache.kafka.connect.source.ExactlyOnceSupport;
import org.apache.kafka.connect.source.SourceConnector;

import io.furrow.connect.CrossFieldValidator;
import io.furrow.connect.PluginVersion;

/**
 * Writes the HTTP notifications of a context broker to Kafka, one record per entity. Each task listens on its own port
 * and has its own journal.
 */
public class NgsiSourceConnector extends SourceConnector {
    private Map<String, String> properties;

    /** Called by the worker. */
    public NgsiSourceConnector() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public ConfigDef config() {
        return NgsiSourceConfig.definition();
    }

    @Override
    public Config validate(Map<String, String> options) {
        return CrossFieldValidator.with(super.validate(options), () -> new NgsiSourceConfig(options));
    }

    @Override
    public Class<? extends Task> taskClass() {
        return NgsiSourceTask.class;
    }

    @Override
    public void start(Map<String, String> properties) {
        new NgsiSourceConfig(properties);
        this.properties = Map.copyOf(properties);
    }

    @Override
    public List<Map<String, String>> taskConfigs(int maxTasks) {
        return IntStream.range(0, maxTasks).mapToObj(i -> task(i, maxTasks)).toList();
    }

    private Map<String, String> task(int index, int count) {
        Map<String, String> task = new HashMap<>(properties);
        task.put(NgsiSourceConfig.TASK_INDEX, Integer.toString(index));
        task.put(NgsiSourceConfig.TASK_COUNT, Integer.toString(count));
        return task;
    }

    /** A journal record and its position in the journal are committed to Kafka together. */
    @Override
    public ExactlyOnceSupport exactlyOnceSupport(Map<String, String> properties) {
        return ExactlyOnceSupport.SUPPORTED;
    }

    /**
     * Accepts any offset of the right shape: an offset before the oldest retained record means the oldest, one beyond
     * the end means the end.
     */
    @Override
    public boolean alterOffsets(Map<String, String> properties, Map<Map<String, ?>, Map<String, ?>> offsets) {
        offsets.forEach(SourceOffsets::require);
        return true;
    }

    @Override
    public void stop() {}
}
